#include "geometry/edit_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "geometry/readers/read_network.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/paths.hpp"

namespace acinus::geometry {
namespace {

// A chain of `n` steps of `step` um along x with the given radius.
Network make_chain(int n, double step, double radius) {
  Network out;
  for (int i = 0; i <= n; ++i) {
    out.node.push_back(Vec3(step * i, 0, 0));
    if (i == 0) continue;
    out.segment.push_back({i - 1, i});
    out.radius.push_back({radius, radius});
  }
  return out;
}

double length_of(const Network& network, std::size_t s) {
  const auto& [a, b] = network.segment[s];
  return (network.node[b] - network.node[a]).norm();
}

double mean_radius(const Network& network, std::size_t s) {
  return (network.radius[s][0] + network.radius[s][1]) / 2;
}

double lateral_area(const Network& network) {
  double area = 0;
  for (std::size_t s = 0; s < network.segment.size(); ++s)
    area += 2 * kPi * mean_radius(network, s) * length_of(network, s);
  return area;
}

std::vector<int> degrees(const Network& network) {
  std::vector<int> degree(network.node.size(), 0);
  for (const auto& [a, b] : network.segment) {
    ++degree[a];
    ++degree[b];
  }
  return degree;
}

// Positions of the nodes that are not of degree 2, in order of x, y, z.
std::vector<std::array<double, 3>> anchors(const Network& network) {
  std::vector<std::array<double, 3>> out;
  const std::vector<int> degree = degrees(network);
  for (std::size_t i = 0; i < degree.size(); ++i) {
    const Vec3& x = network.node[i];
    if (degree[i] != 2 && degree[i] != 0) out.push_back({x.x(), x.y(), x.z()});
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(TransformNetwork, ScalesThenCentresThenShifts) {
  NetworkTransform transform;
  transform.unit = 1000;
  transform.scale = 0.5;
  transform.radius_scale = 2;
  transform.center = true;
  transform.shift = Vec3(0, 7, 0);
  const Network out = transform_network(make_chain(4, 0.1, 0.003), transform);
  EXPECT_NEAR(out.node[0].x(), -100, 1e-12);
  EXPECT_NEAR(out.node[4].x(), 100, 1e-12);
  EXPECT_NEAR(out.node[2].y(), 7, 1e-12);
  EXPECT_NEAR(out.radius[3][1], 3, 1e-12);
  transform.scale = 0;
  EXPECT_CONTAINS(test::message_of([&] { transform_network(out, transform); }), "scale is 0");
}

TEST(CropNetwork, KeepsWholeSegmentsThatEnterTheBox) {
  const Network chain = make_chain(10, 1, 0.5);
  const Network out = crop_network(chain, {Vec3(2.5, -1, -1), Vec3(4.5, 1, 1)});
  ASSERT_EQ(out.segment.size(), 3u);  // 2-3, 3-4, 4-5
  ASSERT_EQ(out.node.size(), 4u);
  EXPECT_EQ(out.node[0], Vec3(2, 0, 0));
  EXPECT_EQ(out.segment[2], (std::array{2, 3}));
  EXPECT_EQ(crop_network(chain, {Vec3(2.2, -1, -1), Vec3(2.8, 1, 1)}).segment.size(),
            1u);  // passes through
  EXPECT_EQ(crop_network(chain, {Vec3(0, 0.1, -1), Vec3(9, 1, 1)}).segment.size(),
            0u);  // beside it
  EXPECT_EQ(crop_network(chain, {Vec3(-9, 0, 0), Vec3(99, 0, 0)}).segment.size(),
            10u);  // faces belong to it
  EXPECT_CONTAINS(test::message_of([&] {
                    crop_network(chain, {Vec3(1, 0, 0), Vec3(0, 1, 1)});
                  }),
                  "must not exceed");
}

TEST(ResampleNetwork, LeavesLongSegmentsAlone) {
  const Network chain = make_chain(10, 1, 2);  // exactly r / 2
  const Network out = resample_network(chain);
  EXPECT_EQ(out.segment, chain.segment);
  EXPECT_EQ(out.radius, chain.radius);
  EXPECT_EQ(out.node, chain.node);
}

TEST(ResampleNetwork, MergesShortSegmentsAndKeepsTheTaper) {
  Network chain = make_chain(100, 0.1, 2);
  for (std::size_t s = 0; s < 100; ++s) {
    chain.radius[s] = {2 + 0.01 * static_cast<double>(s), 2 + 0.01 * static_cast<double>(s + 1)};
  }
  const Network out = resample_network(chain);
  EXPECT_LE(out.segment.size(), 10u);
  EXPECT_GE(out.segment.size(), 6u);
  EXPECT_NEAR(total_length(out), 10, 1e-12);
  EXPECT_NEAR(lateral_area(out), lateral_area(chain), 1e-10);
  for (std::size_t s = 0; s < out.segment.size(); ++s) {
    EXPECT_GE(length_of(out, s), mean_radius(out, s) / 2);
    for (std::size_t end = 0; end < 2; ++end) {  // r = 2 + x / 10
      EXPECT_NEAR(out.radius[s][end], 2 + out.node[out.segment[s][end]].x() / 10, 1e-12);
    }
  }
  EXPECT_EQ(anchors(out), anchors(chain));
}

TEST(ResampleNetwork, JudgesByTheRadiusThatIsKept) {
  Network chain;
  for (const double x : {0.0, 0.45, 0.66, 5.66, 10.66}) chain.node.push_back(Vec3(x, 0, 0));
  chain.segment = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  // The mean over the first two is 1.32, but with no end below 1 the merged segment has 1.66.
  chain.radius = {{1, 1}, {1, 3}, {3, 3}, {3, 3}};
  const Network out = resample_network(chain);
  ASSERT_EQ(out.segment.size(), 2u);
  for (std::size_t s = 0; s < out.segment.size(); ++s)
    EXPECT_GE(length_of(out, s), mean_radius(out, s) / 2);
}

TEST(ResampleNetwork, KeepsBranchPointsAndShortBranches) {
  Network network = make_chain(20, 0.2, 2);
  network.node.push_back(Vec3(2, 0.3, 0));  // a twig shorter than r / 2 at node 10
  network.segment.push_back({10, 21});
  network.radius.push_back({1, 1});
  const Network out = resample_network(network);
  EXPECT_EQ(anchors(out), anchors(network));
  EXPECT_EQ(anchors(out).size(), 4u);
  EXPECT_NEAR(total_length(out), 4.3, 1e-12);
}

TEST(ResampleNetwork, JoinsEqualNodesAndDropsDoubles) {
  Network network = make_chain(2, 3, 1);
  network.node.push_back(network.node[1]);  // 3 = 1
  network.node.push_back(Vec3(3, 3, 0));
  network.segment.insert(network.segment.end(), {{3, 4}, {4, 1}, {1, 3}});
  network.radius.insert(network.radius.end(), {{1, 1}, {1, 1}, {1, 1}});
  const Network out = resample_network(network);
  EXPECT_EQ(out.node.size(), 4u);
  EXPECT_EQ(out.segment.size(), 3u);
  EXPECT_EQ(anchors(out).size(), 4u);  // three ends and one branch point
}

TEST(ResampleNetwork, RingsStayRings) {
  Network ring;
  for (int i = 0; i < 60; ++i) {
    ring.node.push_back(10 * Vec3(std::cos(kPi * i / 30), std::sin(kPi * i / 30), 0));
    ring.segment.push_back({i, (i + 1) % 60});
    ring.radius.push_back({4, 4});
  }
  const Network out = resample_network(ring);
  EXPECT_LT(out.segment.size(), 31u);
  for (const int degree : degrees(out)) EXPECT_EQ(degree, 2);
  EXPECT_NEAR(total_length(out) / total_length(ring), 1, 0.01);
  Network tiny = ring;
  for (Vec3& x : tiny.node) x *= 0.01;  // smaller than its radius: nothing sensible to merge
  EXPECT_EQ(resample_network(tiny).segment.size(), 60u);
  EXPECT_EQ(resample_network(Network{}).node.size(), 0u);
}

void expect_little_change(const std::string& path) {
  const Network before = read_network(path);
  const Network after = resample_network(before);
  std::size_t n_short = 0, n_short_before = 0;
  for (std::size_t s = 0; s < before.segment.size(); ++s)
    n_short_before += length_of(before, s) < mean_radius(before, s) / 2;
  const std::vector<int> degree = degrees(after);
  for (std::size_t s = 0; s < after.segment.size(); ++s) {
    if (length_of(after, s) >= mean_radius(after, s) / 2 - 1e-9) continue;
    ++n_short;  // only a whole chain between two branch points or ends may be short
    for (const int node : after.segment[s]) EXPECT_NE(degree[static_cast<std::size_t>(node)], 2);
  }
  std::printf(
      "%s: %zu -> %zu segments, short %zu -> %zu, length %.2f -> %.2f um, area %.1f -> %.1f "
      "um^2\n",
      path.c_str(), before.segment.size(), after.segment.size(), n_short_before, n_short,
      total_length(before), total_length(after), lateral_area(before), lateral_area(after));
  EXPECT_EQ(anchors(after), anchors(before));
  // Arteries are traced voxel by voxel: up to 2.7 % of their length is wiggles shorter than r / 2.
  EXPECT_NEAR(total_length(after) / total_length(before), 1, 0.03);
  EXPECT_NEAR(lateral_area(after) / lateral_area(before), 1, 0.03);
  // Every node that was dropped lies near one that stayed.
  for (const Vec3& x : before.node) {
    double nearest = 1e9;
    for (const Vec3& y : after.node) nearest = std::min(nearest, (x - y).norm());
    EXPECT_LE(nearest, 14.1 / 2 + 1e-9);
  }
}

TEST(ResampleNetwork, TracedNetworksChangeLittle) {
  for (const char* name : {"capillaries.vtk", "artery.vtk"})
    expect_little_change(test::data_path("files/") + name);
}

TEST(ResampleNetwork, RealNetworksChangeLittle) {
  if (!test::has_real_data()) GTEST_SKIP();
  for (const char* name : {"test_smaller_vasculature.vtk", "penetrating_artery_standardized.vtk"})
    expect_little_change(test::real_path("vascpy/") + name);
}

}  // namespace
}  // namespace acinus::geometry
