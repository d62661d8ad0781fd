#include "geometry/implicit/vessel_mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/closed.hpp"
#include "geometry/implicit/vessel_gaps.hpp"
#include "geometry/implicit/vessel_pieces.hpp"
#include "geometry/measures.hpp"
#include "geometry/readers/read_network.hpp"
#include "geometry/remesh.hpp"
#include "tests/geometry/implicit/expect_vessel_mesh.hpp"
#include "tests/geometry/implicit/random_network.hpp"
#include "tests/paths.hpp"

namespace acinus::geometry {
namespace {

geometry::Network straight(double radius, double length) {
  return {{Vec3(0.3, 0.1, -0.2), Vec3(0.3, 0.1, -0.2) + length * Vec3(1, 2, 3).normalized()},
          {{0, 1}},
          {{radius, radius}}};
}

TEST(VesselMesh, OfAStraightVesselHasItsVolumeAndWall) {
  const geometry::Network n = straight(3, 40);
  const double exact = kPi * 9 * 40 + 4 * kPi * 27 / 3;
  for (const double edge : {0.0, 0.8}) {
    VesselMeshOptions o;
    o.fineness = 0.2;
    o.edge = edge;
    const VesselMesh m = make_vessel_mesh(n, o);
    EXPECT_EQ(m.remeshed, edge > 0);
    EXPECT_TRUE(m.is_as_expected());
    EXPECT_EQ(m.found.euler_number, 2);
    EXPECT_NEAR(geometry::compute_volume(m.surface.node, m.surface.triangle), exact, 0.01 * exact);
    const Deviation d = find_deviation(n, m.surface);
    EXPECT_LT(d.beyond, 0.02);
    EXPECT_LT(d.rms, 0.025);
  }
}

/// Inscribed triangles are too small by fineness^2; what is left after the correction is of higher
/// order.
TEST(VesselMesh, VolumeConverges) {
  const geometry::Network n = straight(3, 40);
  const double exact = kPi * 9 * 40 + 4 * kPi * 27 / 3;
  std::vector<double> error;
  for (const double fineness : {0.4, 0.2, 0.1}) {
    VesselMeshOptions o;
    o.fineness = fineness;
    const geometry::Surface s = make_vessel_mesh(n, o).surface;
    error.push_back(std::abs(geometry::compute_volume(s.node, s.triangle) / exact - 1));
  }
  EXPECT_LT(error[0], 0.006);
  EXPECT_LT(error[1], 0.002);
  EXPECT_LT(error[2], 0.0005);
}

TEST(VesselMesh, LoopIsARing) {
  geometry::Network n;
  constexpr int kNodes = 12;
  for (int k = 0; k < kNodes; ++k) {
    const double angle = 2 * kPi * k / kNodes;
    n.node.emplace_back(20 * std::cos(angle), 20 * std::sin(angle), 0);
    n.segment.push_back({k, (k + 1) % kNodes});
    n.radius.push_back({2, 2});
  }
  const VesselMesh m = make_vessel_mesh(n, {});
  EXPECT_EQ(m.found.euler_number, 0);
  EXPECT_EQ(m.found.handles(), 1);
  expect_sound(n, m, "ring");
}

/// No rounding joins vessels that pass each other, and the triangles become small enough.
TEST(VesselMesh, CrossingVesselsStayApart) {
  const double gap = 1.2;
  const geometry::Network n{
      {Vec3(-10, 0, 0), Vec3(10, 0, 0), Vec3(0, -10, 4 + gap), Vec3(0, 10, 4 + gap)},
      {{0, 1}, {2, 3}},
      {{2, 2}, {2, 2}}};
  const VesselMesh m = make_vessel_mesh(n, {});
  EXPECT_EQ(m.found.parts, 2);
  EXPECT_TRUE(m.is_as_expected());
}

/// Narrow gap: only the triangles there become small. Beside a short segment there is no gap.
TEST(VesselMesh, NearlyTouchingVesselsStayApart) {
  for (const double gap : {0.5, 0.2}) {
    const geometry::Network n{{Vec3(-10, 0, 0), Vec3(10, 0, 0), Vec3(0, -10, 4 + gap),
                               Vec3(0, 10, 4 + gap), Vec3(13, 0, 0), Vec3(30, 0, 0)},
                              {{0, 1}, {2, 3}, {1, 4}, {4, 5}},
                              {{2, 2}, {2, 2}, {2, 2}, {2, 2}}};
    const VesselGaps gaps = find_narrow_gaps(n, 0.1, 1.2);
    EXPECT_EQ(gaps.overlapping, 0);
    double least = 2.4;
    for (const FineBall& ball : gaps.fine) {
      least = std::min(least, ball.size);
      EXPECT_LT((ball.center - Vec3(0, 0, 2 + gap / 2)).norm(), 5) << "where they pass each other";
    }
    EXPECT_LT(least, 0.9 * gap);
    EXPECT_GT(least, 0.4 * gap);
    const VesselMesh m = make_vessel_mesh(n, {});
    EXPECT_EQ(m.fineness, VesselMeshOptions{}.fineness);
    EXPECT_TRUE(m.is_as_expected()) << gap;
  }
  const geometry::Network crossing{
      {Vec3(-10, 0, 0), Vec3(10, 0, 0), Vec3(0, -10, 3), Vec3(0, 10, 3)},
      {{0, 1}, {2, 3}},
      {{2, 2}, {2, 2}}};
  const VesselMesh m = make_vessel_mesh(crossing, {});
  EXPECT_EQ(m.overlapping, 1);
  EXPECT_EQ(m.found.parts, 1);
}

/// However sharp the angle, between walls that widen away from the node as well.
TEST(VesselMesh, VesselsThatLeaveOneNodeStayApart) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vec3(x, y, z);
  };
  for (const double far : {1.0, 3.0, 10.0})
    for (const double degrees : {20.0, 40.0, 61.0, 75.0, 90.0, 130.0})
      for (int k = 0; k < 4; ++k) {
        const Vec3 start = draw(), u = draw().normalized(), across = u.cross(draw()).normalized();
        const double angle = degrees * kPi / 180, length = (3 + 2 * k) * far;
        const geometry::Network n{
            {start, start + length * u,
             start + length * (std::cos(angle) * u + std::sin(angle) * across)},
            {{0, 1}, {2, 0}},
            {{1, far}, {far, 1}}};
        VesselMeshOptions o;
        o.attempts = 1;
        const VesselMesh m = make_vessel_mesh(n, o);
        EXPECT_TRUE(m.is_as_expected()) << far << " um, " << degrees << " degrees, " << k;
      }
}

/// Cut of a cone where it gets thinner: where it is thick its triangles are larger.
TEST(VesselMesh, PiecesOfAConeHaveTheirOwnSize) {
  const geometry::Network n{{Vec3(0, 0, 0), Vec3(60, 0, 0)}, {{0, 1}}, {{1, 20}}};
  const VesselPieces pieces = cut_vessels(n, 1.2);
  EXPECT_EQ(pieces.size, (std::vector<double>{1.2, 2.4, 4.8, 9.6}));
  for (std::size_t k = 0; k < pieces.size.size(); ++k) {
    EXPECT_LE(pieces.size[k], 1.2 * pieces.network.radius[k][0] + 1e-9);
    EXPECT_GT(pieces.size[k], 0.5 * pieces.network.radius[k][0]);
  }
  EXPECT_NEAR(geometry::total_length(pieces.network), 60, 1e-9);
}

TEST(VesselMesh, ThickAndThinMeet) {
  const geometry::Network n{{Vec3(0, 0, 0), Vec3(60, 0, 0), Vec3(30, 0, 0), Vec3(30, 25, 0)},
                            {{0, 2}, {2, 1}, {2, 3}},
                            {{10, 10}, {10, 10}, {1, 0.5}}};
  expect_sound(n, make_vessel_mesh(n, {}), "thick and thin");
}

/// No crease is where vessels go on straight.
TEST(VesselMesh, RoundingIsOnlyInCreases) {
  const geometry::Network chain{
      {Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(20, 0, 0)}, {{0, 1}, {1, 2}}, {{2, 2}, {2, 2}}};
  VesselMeshOptions sharp, round;
  sharp.rounding = 0;
  round.rounding = 0.5;
  const auto volume = [](const geometry::Network& n, const VesselMeshOptions& o) {
    const geometry::Surface s = make_vessel_mesh(n, o).surface;
    return geometry::compute_volume(s.node, s.triangle);
  };
  EXPECT_NEAR(volume(chain, round), volume(chain, sharp), 1e-4 * volume(chain, sharp));
  geometry::Network branch = chain;
  branch.node.emplace_back(10, 10, 0);
  branch.segment.push_back({1, 3});
  branch.radius.push_back({2, 2});
  EXPECT_GT(volume(branch, round), 1.001 * volume(branch, sharp));
}

TEST(VesselMesh, IsTheSameForAnyThreads) {
  const geometry::Network n = RandomNetwork(3, 1, 4).grow(20);
  set_threads(1);
  const geometry::Surface one = make_vessel_mesh(n, {}).surface;
  set_threads(3);
  const geometry::Surface three = make_vessel_mesh(n, {}).surface;
  set_threads(1);
  EXPECT_EQ(one.triangle, three.triangle);
  EXPECT_EQ(one.node, three.node);
}

TEST(VesselMesh, OfRandomNetworksIsSound) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const double thickest = seed % 2 == 0 ? 12 : 3;
    const geometry::Network n = RandomNetwork(seed, 1, thickest).grow(8 + 8 * seed);
    const VesselMesh m = make_vessel_mesh(n, {});
    expect_sound(n, m, fmt::format("seed {}", seed));
    const Deviation d = find_deviation(n, m.surface);
    EXPECT_LT(d.beyond, 0.05) << seed;
    EXPECT_LT(d.rms, 0.03) << seed;
  }
}

TEST(VesselMesh, BadRadiiAreRefused) {
  geometry::Network n = straight(3, 10);
  n.radius[0][1] = 0;
  EXPECT_THROW(make_vessel_mesh(n, {}), Error);
  n.radius[0][1] = std::nan("");
  EXPECT_THROW(make_vessel_mesh(n, {}), Error);
  EXPECT_THROW(make_vessel_mesh({}, {}), Error);
}

TEST(VesselMesh, OfRealNetworksIsSound) {
  if (!test::has_real_data()) GTEST_SKIP();
  for (const char* name : {"test_smaller_vasculature.vtk", "penetrating_artery_standardized.vtk"}) {
    const geometry::Network n =
        geometry::resample_network(geometry::read_network(test::real_path("vascpy/") + name));
    const VesselMesh m = make_vessel_mesh(n, {});
    EXPECT_NO_THROW(geometry::check_manifold(m.surface, name));
    EXPECT_FALSE(geometry::crosses_itself(m.surface)) << name;
    const UnionVolume sampled = sample_union(n, 20000, 1);
    EXPECT_NEAR(geometry::compute_volume(m.surface.node, m.surface.triangle), sampled.volume,
                0.01 * sampled.volume + 2 * sampled.deviation)
        << name;
  }
}

}  // namespace
}  // namespace acinus::geometry
