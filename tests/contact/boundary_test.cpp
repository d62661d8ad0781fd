#include "contact/boundary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

/// Smallest |x - c(t)| - r(t) over balls strung on the axis: a fine scan, then golden section.
double scanned_gap(const Vec3& a, const Vec3& b, double ra, double rb, const Vec3& x) {
  const auto gap = [&](double t) { return (x - a - t * (b - a)).norm() - ra - t * (rb - ra); };
  int best = 0;
  const int n = 400;
  for (int k = 1; k <= n; ++k)
    if (gap(static_cast<double>(k) / n) < gap(static_cast<double>(best) / n)) best = k;
  double low = std::max(0.0, (best - 1.0) / n), high = std::min(1.0, (best + 1.0) / n);
  for (int k = 0; k < 60; ++k) {
    const double p = high - 0.6180339887498949 * (high - low),
                 q = low + 0.6180339887498949 * (high - low);
    (gap(p) < gap(q) ? high : low) = gap(p) < gap(q) ? q : p;
  }
  return std::min({gap((low + high) / 2), gap(0), gap(1)});
}

TEST(GapToSegment, IsTheSmallestGapToAnyBallOnTheAxis) {
  auto random = reference::stream(50);
  double worst = 0;
  for (int k = 0; k < 3000; ++k) {
    geometry::Network n;
    n.node = {reference::random_vector(random, 10), reference::random_vector(random, 10)};
    n.segment = {{0, 1}};
    // Cylinders, cones, and ends that swallow each other.
    const double ra = random.uniform(1, 6),
                 rb = k % 3 == 0 ? ra : random.uniform(1, k % 7 == 0 ? 40 : 6);
    n.radius = {{ra, rb}};
    const Vec3 x = reference::random_vector(random, 25);
    const Gap g = gap_to_segment(n, 0, x);
    worst = std::max(worst, std::abs(g.gap - scanned_gap(n.node[0], n.node[1], ra, rb, x)));
    EXPECT_NEAR(g.gap, g.axis_distance - g.radius, 1e-14);
    EXPECT_NEAR(g.radius, ra + g.parameter * (rb - ra), 1e-13);
  }
  std::printf("round cone against scan: %.1e um\n", worst);
  EXPECT_LT(worst, 1e-11);  // golden section finds the place to sqrt(kEps), the value to kEps
}

TEST(GapToSegment, NormalIsTheGradient) {
  auto random = reference::stream(51);
  const double h = 1e-5;
  double worst = 0;
  for (int k = 0; k < 500; ++k) {
    geometry::Network n;
    n.node = {reference::random_vector(random, 10), reference::random_vector(random, 10)};
    n.segment = {{0, 1}};
    n.radius = {{random.uniform(1, 5), random.uniform(1, 5)}};
    const Vec3 x = reference::random_vector(random, 25);
    const Gap g = gap_to_segment(n, 0, x);
    if (g.axis_distance < 1) continue;
    EXPECT_NEAR(g.normal.norm(), 1, 1e-14);
    for (int c = 0; c < 3; ++c) {
      const double slope = (gap_to_segment(n, 0, x + h * Vec3::Unit(c)).gap -
                            gap_to_segment(n, 0, x - h * Vec3::Unit(c)).gap) /
                           (2 * h);
      worst = std::max(worst, std::abs(slope - g.normal[c]));
    }
  }
  std::printf("round cone normal against differences: %.1e\n", worst);
  EXPECT_LT(worst, 1e-5);  // h times the curvature 1/um where x crosses from cone to cap within h
}

TEST(GapToSegment, OnTheAxisTheNormalIsAcross) {
  geometry::Network n;
  n.node = {{0, 0, 0}, {10, 0, 0}};
  n.segment = {{0, 1}};
  n.radius = {{2, 2}};
  const Gap g = gap_to_segment(n, 0, {4, 0, 0});
  EXPECT_DOUBLE_EQ(g.gap, -2);
  EXPECT_NEAR(g.normal.norm(), 1, 1e-15);
  EXPECT_NEAR(g.normal.x(), 0, 1e-15);
}

/// Straight chain of segments along a random line, total length 60 um, cut at random places.
Vessels straight_chain(UniformStream& random, int pieces, const Vec3& from, const Vec3& to,
                       double r0, double r1) {
  std::vector<double> cut{0, 1};
  for (int k = 1; k < pieces; ++k) cut.push_back(random.uniform());
  std::ranges::sort(cut);
  geometry::Network n;
  for (double t : cut) n.node.push_back(from + t * (to - from));
  for (int k = 0; k < pieces; ++k) {
    const std::size_t i = k;
    n.segment.push_back(k % 2 == 0 ? std::array{k, k + 1} : std::array{k + 1, k});
    const double a = r0 + cut[i] * (r1 - r0), b = r0 + cut[i + 1] * (r1 - r0);
    n.radius.push_back(k % 2 == 0 ? std::array{a, b} : std::array{b, a});
  }
  Vessels v;
  set_network(v, n);
  return v;
}

int count_contacts(const Vessels& v, const Vec3& x) {
  int count = 0;
  for (int s = 0; s < static_cast<int>(v.network.segment.size()); ++s)
    count += is_local_minimum(v, s, x, gap_to_segment(v.network, s, x)) ? 1 : 0;
  return count;
}

TEST(IsLocalMinimum, StraightChainGivesOneContactForAnySpacing) {
  auto random = reference::stream(52);
  int wrong = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from = reference::random_vector(random, 40), u = random.unit_vector();
    const int pieces = 1 + static_cast<int>(random.index(40));
    const Vessels v =
        straight_chain(random, pieces, from, from + 60 * u, 4.7, k % 2 == 0 ? 4.7 : 7);
    const Vec3 side = u.unitOrthogonal();
    const Vec3 x = from + random.uniform(-10, 70) * u + random.uniform(1, 20) * side;
    wrong += count_contacts(v, x) == 1 ? 0 : 1;
    // Exactly beside a joint, too.
    const Vec3 joint = v.network.node[random.index(v.network.node.size())];
    if (k % 2 == 0) wrong += count_contacts(v, joint + 15 * side) == 1 ? 0 : 1;
  }
  std::printf("straight chains: %d of 1500 positions without exactly one contact\n", wrong);
  EXPECT_EQ(wrong, 0);
}

TEST(IsLocalMinimum, BranchGivesAtLeastOneContact) {
  auto random = reference::stream(53);
  int none = 0, most = 0;
  for (int k = 0; k < 2000; ++k) {
    geometry::Network n;
    n.node.push_back(reference::random_vector(random, 5));
    const int arms = 2 + static_cast<int>(random.index(3));
    for (int a = 0; a < arms; ++a) {
      n.node.push_back(n.node[0] + random.uniform(5, 30) * random.unit_vector());
      n.segment.push_back(a % 2 == 0 ? std::array{0, a + 1} : std::array{a + 1, 0});
      // One radius per segment is what a file with cell data gives: the arms need not agree at the
      // node.
      const double r = k % 2 == 0 ? 4.7 : random.uniform(3, 8);
      n.radius.push_back({r, r});
    }
    Vessels v;
    set_network(v, n);
    const int count = count_contacts(v, n.node[0] + random.uniform(2, 25) * random.unit_vector());
    none += count == 0 ? 1 : 0;
    most = std::max(most, count);
  }
  std::printf("branches: %d of 2000 positions without contact, at most %d contacts\n", none, most);
  EXPECT_EQ(none, 0);
  EXPECT_LE(most, 4);
}

// The nearest place of the whole network must be among the contacts, whatever the radii.
TEST(IsLocalMinimum, NearestPlaceOfANetworkCounts) {
  auto random = reference::stream(54);
  for (int k = 0; k < 600; ++k) {
    geometry::Network n;
    for (int i = 0; i < 12; ++i) n.node.push_back(reference::random_vector(random, 30));
    for (int i = 1; i < 12; ++i) {
      n.segment.push_back({static_cast<int>(random.index(static_cast<std::uint64_t>(i))), i});
      const double r = k % 2 == 0 ? 4.7 : random.uniform(3, 8);
      n.radius.push_back({r, r});
    }
    Vessels v;
    set_network(v, n);
    const Vec3 x = reference::random_vector(random, 40);
    double nearest = 1e300, contact = 1e300;
    for (int s = 0; s < 11; ++s) {
      const Gap g = gap_to_segment(v.network, s, x);
      nearest = std::min(nearest, g.gap);
      if (is_local_minimum(v, s, x, g)) contact = std::min(contact, g.gap);
    }
    EXPECT_NEAR(contact, nearest, 1e-9);
  }
}

// Cell data give every segment one radius of its own: a stepped tube still has one wall beside x.
TEST(IsLocalMinimum, SteppedTubeGivesOneContactBesideItsWall) {
  geometry::Network n;
  n.node = {{0, 0, 0}, {20, 0, 0}, {40, 0, 0}, {60, 0, 0}};
  n.segment = {{1, 0}, {1, 2}, {3, 2}};
  n.radius = {{5, 5}, {4, 4}, {6, 6}};
  Vessels v;
  set_network(v, n);
  double last = 0;
  for (double s = -5; s < 65; s += 0.01) {
    const Vec3 x(s, 15, 0);
    int count = 0;
    double gap = 0;
    for (int k = 0; k < 3; ++k) {
      const Gap g = gap_to_segment(v.network, k, x);
      if (!is_local_minimum(v, k, x, g)) continue;
      ++count;
      gap = g.gap;
    }
    EXPECT_EQ(count, 1) << s;
    if (s > -5) {
      EXPECT_LT(std::abs(gap - last), 0.011) << s;  // no jump: a step of 0.01 um moves it no more
    }
    last = gap;
  }
}

TEST(Plane, GapAndMotion) {
  Plane p;
  p.point = {1, 2, 3};
  p.normal = Vec3(1, 2, 2) / 3;
  EXPECT_NEAR(gap_to_wall(p, Vec3(1, 2, 3) + 4 * p.normal, 100).gap, 4, 1e-14);
  EXPECT_EQ(gap_to_wall(p, {0, 0, 0}, 0).normal, p.normal);
  p.speed = 0.5;
  p.travel = 3;
  EXPECT_NEAR(gap_to_wall(p, Vec3(1, 2, 3), 2).gap, -1, 1e-14);
  EXPECT_NEAR(gap_to_wall(p, Vec3(1, 2, 3), 1e6).gap, -3, 1e-14);
  EXPECT_NEAR(gap_to_wall(p, Vec3(1, 2, 3), -50).gap, 0, 1e-14);  // start-up: not yet moving
  p.speed = -0.5;
  EXPECT_NEAR(gap_to_wall(p, Vec3(1, 2, 3), 2).gap, 1, 1e-14);
}

TEST(Capsule, IsGoneOnceItOpens) {
  Capsule c;
  c.radius = 50;
  c.speed = 0.01;
  c.min_radius = 20;
  c.opens = 1000;
  // A step that ends as it opens still meets it.
  EXPECT_NEAR(gap_to_wall(c, Vec3(0, 0, 30), 1000).gap, 50 - 10 - 30, 1e-12);
  EXPECT_EQ(gap_to_wall(c, Vec3(0, 0, 30), 1000.001).gap, std::numeric_limits<double>::infinity());
}

TEST(Plane, IsGoneOnceItOpens) {
  Plane p;
  p.normal = Vec3(0, 0.6, 0.8);
  p.speed = 0.01;
  p.travel = 5;
  p.opens = 1000;
  EXPECT_NEAR(gap_to_wall(p, 3 * p.normal, 100).gap, 2, 1e-12);
  EXPECT_NEAR(gap_to_wall(p, 3 * p.normal, 1000).gap, -2, 1e-12);
  EXPECT_GT(gap_to_wall(p, 3 * p.normal, 1000.001).gap, 1e8);
}

TEST(Capsule, GapAndShrinking) {
  Capsule c;
  c.center = {1, 0, 0};
  c.radius = 100;
  c.speed = 0.1;
  c.min_radius = 80;
  EXPECT_NEAR(gap_to_wall(c, {91, 0, 0}, 0).gap, 10, 1e-13);
  EXPECT_NEAR(gap_to_wall(c, {91, 0, 0}, 50).gap, 5, 1e-13);
  EXPECT_NEAR(gap_to_wall(c, {91, 0, 0}, 1e6).gap, -10, 1e-13);
  EXPECT_NEAR(gap_to_wall(c, {91, 0, 0}, -1e6).gap, 10, 1e-13);
  EXPECT_LT((gap_to_wall(c, {91, 0, 0}, 0).normal - Vec3(-1, 0, 0)).norm(), 1e-15);
  EXPECT_NEAR(gap_to_wall(c, c.center, 0).normal.norm(), 1, 1e-15);
}

// A tube along z that begins at z = 0: inner radius 5, outer 8, rims rounded with 1.
TEST(Pipette, GapByHand) {
  Pipette p;
  p.radius = 5;
  p.thickness = 3;
  p.lip = 1;
  p.length = 40;
  const auto gap = [&](double r, double z) { return gap_to_wall(p, Vec3(0, r, z), 0).gap; };
  EXPECT_DOUBLE_EQ(gap(0, 20), 5);
  EXPECT_DOUBLE_EQ(gap(4, 20), 1);
  EXPECT_DOUBLE_EQ(gap(10, 20), 2);
  EXPECT_DOUBLE_EQ(gap(6.5, -3), 3);
  EXPECT_DOUBLE_EQ(gap(6.5, 44), 4);
  EXPECT_DOUBLE_EQ(gap(6 - 3, 1 - 4), 4);   // 5 from the middle of the lip's ring
  EXPECT_DOUBLE_EQ(gap(7 + 4, 39 + 3), 4);  // and of that at the other end, outside
  EXPECT_DOUBLE_EQ(gap(6.5, 20), -1.5);
  EXPECT_DOUBLE_EQ(gap(5.5, 20), -0.5);
  EXPECT_DOUBLE_EQ(gap(6.5, 0.25), -0.25);
  EXPECT_LT((gap_to_wall(p, Vec3(0, 4, 20), 0).normal - Vec3(0, -1, 0)).norm(), 1e-15);
  EXPECT_LT((gap_to_wall(p, Vec3(0, 9, 20), 0).normal - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((gap_to_wall(p, Vec3(0, 3, -3), 0).normal - Vec3(0, -0.6, -0.8)).norm(), 1e-15);
  EXPECT_NEAR(gap_to_wall(p, Vec3(0, 0, 20), 0).normal.norm(), 1, 1e-15) << "on the axis";
  p.opens = 10;
  EXPECT_EQ(gap_to_wall(p, Vec3(0, 0, 20), 11).gap, std::numeric_limits<double>::infinity());
}

/// One wall of each kind, all of them moving that can.
Boundary make_walls() {
  Plane plane;
  plane.name = "floor";
  plane.normal = Vec3(0, 0.6, 0.8);
  plane.speed = 0.1;
  plane.travel = 100;
  plane.material.adhesion = 1;
  Capsule capsule;
  capsule.name = "capsule";
  capsule.center = Vec3(1, 2, 3);
  capsule.radius = 50;
  capsule.speed = 0.1;
  capsule.material.adhesion = 2;
  Boundary b;
  b.planes = {Plane{}, plane};
  b.capsules = {capsule};
  Pipette pipette;
  pipette.name = "pipette";
  pipette.mouth = Vec3(20, -30, 40);
  pipette.axis = Vec3(0.48, 0.6, 0.64);
  pipette.radius = 5;
  pipette.thickness = 3;
  pipette.lip = 1;
  pipette.length = 40;
  pipette.material.adhesion = 3;
  b.pipettes = {pipette};
  return b;
}

TEST(EveryWall, NormalIsTheGradientOfItsGap) {
  const Boundary boundary = make_walls();
  const Vec3 x(3, -4, 12);
  const double h = 1e-3;  // um: h^2 times the third derivative and kEps gap / h are below 1e-8
  for_each_wall(boundary, [&](auto, auto, const auto& wall) {
    const Vec3 normal = gap_to_wall(wall, x, 7).normal;
    EXPECT_NEAR(normal.norm(), 1, 1e-15);
    for (int k = 0; k < 3; ++k) {
      const double more = gap_to_wall(wall, x + h * Vec3::Unit(k), 7).gap,
                   less = gap_to_wall(wall, x - h * Vec3::Unit(k), 7).gap;
      EXPECT_NEAR((more - less) / (2 * h), normal[k], 1e-8) << wall_label(wall);
    }
  });
}

TEST(EveryWall, StaysWhereItIsStopped) {
  Boundary boundary = make_walls();
  const Vec3 x(3, -4, 12);
  for_each_wall(boundary, [&](auto, auto, auto& wall) {
    const double gap = gap_to_wall(wall, x, 70).gap;
    stop_wall(wall, 70);
    EXPECT_EQ(gap_to_wall(wall, x, 70).gap, gap) << wall_label(wall);
    EXPECT_EQ(gap_to_wall(wall, x, 1e6).gap, gap) << wall_label(wall);
  });
}

TEST(EveryWall, IsVisitedWithItsKindAndPlace) {
  const Boundary boundary = make_walls();
  std::vector<std::string> labels;
  for_each_wall(boundary, [&](Partner kind, int index, const auto& wall) {
    EXPECT_EQ(&material_of(boundary, kind, index), &wall.material);
    labels.push_back(wall_label(wall));
  });
  EXPECT_EQ(labels,
            (std::vector<std::string>{"wall \"\"", "wall \"floor\"", "the wall of the capsule",
                                      "the wall of the pipette"}));
  EXPECT_EQ(&material_of(boundary, Partner::kVessel, 3), &boundary.vessels.material);
}

}  // namespace
}  // namespace acinus::contact
