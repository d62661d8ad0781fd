/// Areas that contact points stand for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "dcm/contact/contact_points.hpp"
#include "tests/dcm/clump.hpp"
#include "tests/dcm/quadratures.hpp"

namespace acinus::dcm {
namespace {

TEST(ContactAreas, PointsShareTheSurface) {
  for (int n : {42, 162})
    for (const auto q : kAll) {
      const geometry::Topology& t = geometry::shared_icosphere(n);
      contact::SurfaceBody b;
      b.topology = &t;
      b.triangle = &t.triangle;
      b.node = t.rest;
      double sum = 0;
      for (int p = 0; p < static_cast<int>(contact::n_points(b, q)); ++p) {
        const double area = point_area(t, q, p, 3);
        EXPECT_NEAR(area, 9 * rest_share(t, q, p), 1e-13);  // three sums of a few areas below 1
        sum += area;
      }
      EXPECT_NEAR(sum, 9 * t.rest_area, 1e-12 * sum);  // a thousand round-offs of kEps
    }
}

TEST(ContactAreas, StretchIsPresentOverReferenceArea) {
  const geometry::Topology& t = geometry::shared_icosphere(42);
  contact::SurfaceBody b;
  b.topology = &t;
  b.triangle = &t.triangle;
  for (const Vec3& x : t.rest) b.node.push_back(3 * 1.2 * x);
  for (const auto q : kAll)
    for (int p = 0; p < static_cast<int>(contact::n_points(b, q)); ++p)
      EXPECT_NEAR(point_stretch(b, q, p, 3), 1.44, 1e-14);  // round-offs of some areas
  // One triangle twice as high: 2 of its own points, and of the others what it is a share of.
  const auto& [i, j, k] = t.triangle[0];
  const Vec3 foot = b.node[i] + (b.node[k] - b.node[i]).dot(b.node[j] - b.node[i]) /
                                    (b.node[j] - b.node[i]).squaredNorm() * (b.node[j] - b.node[i]);
  b.node[k] += b.node[k] - foot;
  EXPECT_NEAR(point_stretch(b, contact::Quadrature::kThreePoint, 0, 3), 2 * 1.44, 1e-13);
  const std::array<int, 2> edge{std::min(i, j), std::max(i, j)};
  const auto at = static_cast<int>(std::ranges::find(t.edge, edge) - t.edge.begin());
  const auto& [f, g] = t.edge_triangle[at];
  const double own = t.rest_triangle_area[0], other = t.rest_triangle_area[f == 0 ? g : f];
  EXPECT_NEAR(point_stretch(b, contact::Quadrature::kNodesAndEdges, t.n_node + at, 3),
              1.44 * (2 * own + other) / (own + other), 1e-13);
}

/// Cube with n by n squares a side.
geometry::Surface make_cube(int n) {
  geometry::Surface s;
  auto number = [&s](const Vec3& x) {
    const auto at = std::ranges::find(s.node, x);
    if (at != s.node.end()) return static_cast<int>(at - s.node.begin());
    s.node.push_back(x);
    return static_cast<int>(s.node.size()) - 1;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          auto corner = [&](int u, int v) {
            Vec3 x;
            x[axis] = side;
            x[(axis + 1) % 3] = i + (side == 0 ? v : u);  // turns outward
            x[(axis + 2) % 3] = j + (side == 0 ? u : v);
            return number(x);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          s.triangle.push_back({a, b, c});
          s.triangle.push_back({a, c, d});
        }
  return s;
}

// A flat side is pulled off a larger one: the work is W times its area, half of it in the pass in
// which its own points probe. Points at the rim of the side also stand for a part of the next
// sides.
TEST(ContactLoads, FlatPatchesTakeTheWorkOfAdhesionToPart) {
  const geometry::Topology t = geometry::make_topology(make_cube(4));
  const double radius = 10;
  const double half = radius * t.rest.front().cwiseAbs().maxCoeff();  // of a side, um
  for (const auto q : kAll) {
    Clump c;
    NewCell below = new_cell(0, {0, 0, 0}, radius, Mat3::Identity());
    NewCell above = new_cell(1, {0, 0, 0}, 1.5 * radius, Mat3::Identity());
    below.topology = above.topology = &t;
    c.options.quadrature = q;
    c.options.range_factor = 0.1;  // so that the next sides are out of range
    const double range = c.options.range_factor * t.mean_rest_length * radius;
    above.center = {0, 0, 2.5 * half + range / 2};
    c.add_cells({below, above});
    c.find();
    double pull = 0;
    for (std::size_t l = 0; l < c.links.size(); ++l)
      if (c.surface()[l].a == 0) pull += c.force(l).z();
    // The pull is a cubic of the gap that vanishes at both ends of the range: Simpson's rule.
    const double work = 2 * range / 6 * 4 * pull;
    double touched = 0;
    for (std::size_t k = 0; k < t.triangle.size(); ++k) {
      int corners = 0;  // of the triangle that lie on the side
      for (int i : t.triangle[k]) corners += t.rest[i].z() * radius > half - 1e-9 ? 1 : 0;
      const int edges = corners == 3 ? 3 : corners == 2 ? 1 : 0;
      double share = corners == 3 ? 1 : 0;
      if (q == contact::Quadrature::kNodes) share = corners / 3.0;
      if (q == contact::Quadrature::kNodesAndEdges) share = (corners + 3 * edges) / 12.0;
      touched += share * t.rest_triangle_area[k] * radius * radius;
    }
    const double flat = 4 * half * half;
    std::printf("work to part flat sides of %.0f um^2: %.4f W A\n", flat,
                work / (c.params[0].adhesion * flat));
    EXPECT_GE(touched, flat * (1 - 1e-12));
    // weights that are floats shift gaps by 1e-7 of an edge, 1e-5 of the range
    EXPECT_NEAR(work, c.params[0].adhesion * touched, 1e-5 * work);
  }
}

}  // namespace
}  // namespace acinus::dcm
