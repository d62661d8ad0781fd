#include "geometry/cut.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "geometry/closed.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/reference/cell_shapes.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::geometry {
namespace {

using reference::kEps;

// Throws with the bad edge unless both halves are watertight; the halves must add up to the whole.
void expect_halves(const Surface& whole, const CutPlane& plane, const Cut& cut, double tolerance) {
  ASSERT_EQ(cut.loop.size(), 1u);
  const double below = compute_volume_below(whole.node, whole.triangle, plane);
  const double total = compute_volume(whole.node, whole.triangle);
  ASSERT_NO_THROW(check_manifold(cut.half[0], "below"));
  ASSERT_NO_THROW(check_manifold(cut.half[1], "above"));
  for (std::size_t h = 0; h < 2; ++h) {
    const Surface& half = cut.half[h];
    EXPECT_NEAR(compute_volume(half.node, half.triangle), h == 0 ? below : total - below,
                tolerance * total);
    // genus 0: nodes - edges + triangles = 2 with three edges to two triangles
    EXPECT_EQ(2 * half.node.size(), half.triangle.size() + 4);
    for (std::size_t k = 0; k < cut.loop[0].size(); ++k)
      EXPECT_EQ(half.node[half.node.size() - cut.loop[0].size() + k], cut.loop[0][k]);
    for (const Vec3& x : half.node) {
      const double height = plane.normal.dot(x) - plane.offset;
      EXPECT_LE(h == 0 ? height : -height, 1e-12 * (x.norm() + std::cbrt(total)));
    }
  }
}

TEST(VolumeBelow, CutsACornerAndASlabOffABox) {
  Surface box = make_box(Vec3(1, 2, 3));
  const double t = 0.7;  // x + y + z < t is a corner of volume t^3 / 6
  const CutPlane corner{Vec3(1, 1, 1) / std::sqrt(3.0), t / std::sqrt(3.0)};
  EXPECT_NEAR(compute_volume_below(box.node, box.triangle, corner), t * t * t / 6, 100 * kEps);
  const CutPlane slab{Vec3::UnitZ(), 1.25};
  EXPECT_NEAR(compute_volume_below(box.node, box.triangle, slab), 2.5, 100 * kEps);
  EXPECT_EQ(compute_volume_below(box.node, box.triangle, {Vec3::UnitZ(), -1}), 0);
  EXPECT_NEAR(compute_volume_below(box.node, box.triangle, {Vec3::UnitZ(), 4}), 6, 100 * kEps);
}

TEST(VolumeBelow, ConvergesToTheSphericalCapAtSecondOrder) {
  for (const double height : {0.2, 0.8, 1.0, 1.5}) {  // pi h^2 (3 - h) / 3
    const double exact = kPi * height * height * (3 - height) / 3;
    const CutPlane plane{Vec3(2, -1, 3).normalized(), height - 1};
    double coarse = 0;
    for (const int n_node : {642, 2562}) {
      const Surface sphere = make_sphere(n_node, 1);
      const double loss = exact - compute_volume_below(sphere.node, sphere.triangle, plane);
      // An inscribed mesh lies in from the sphere by l^2 / 8 on average, l^2 = 16 pi / (sqrt 3 n)
      // with n triangles, over the cap's area 2 pi h.
      const double expected = 2 * kPi * height * 2 * kPi / (std::sqrt(3.0) * 2 * (n_node - 2));
      std::printf("cap %.1f, %d nodes: loss %.2e, expected %.2e\n", height, n_node, loss, expected);
      EXPECT_NEAR(loss, expected, 0.15 * expected);
      if (coarse > 0) {
        EXPECT_NEAR(std::log2(coarse / loss), 2, 0.25);
      }
      coarse = loss;
    }
  }
}

TEST(HalvingPlane, PassesThroughTheCentreOfSymmetricBodies) {
  UniformStream random = reference::stream(1);
  const Vec3 center(300, -200, 100);
  for (int n = 0; n < 20; ++n) {
    Surface shape = make_sphere(162, 1);
    const Mat3 turn = reference::random_rotation(random);
    for (Vec3& x : shape.node) x = center + turn * x.cwiseProduct(Vec3(5, 9, 20));
    const Vec3 normal = random.unit_vector();
    const auto plane = find_halving_plane(shape.node, shape.triangle, normal);
    ASSERT_TRUE(plane);
    EXPECT_EQ(plane->normal, normal);
    // Volume to 1e-12 of 3770; the cut is at least 140 um^2 wide.
    EXPECT_NEAR(plane->offset, normal.dot(center), 1e-10);
  }
}

TEST(HalvingPlane, RefusesABodyWithoutVolume) {
  Surface box = make_box(Vec3(1, 2, 3));
  for (auto& t : box.triangle) std::swap(t[0], t[1]);
  EXPECT_FALSE(find_halving_plane(box.node, box.triangle, Vec3::UnitX()));
  EXPECT_FALSE(find_halving_plane({}, {}, Vec3::UnitX()));
}

TEST(CutSurface, HalvesAreWatertightEqualAndAddUp) {
  UniformStream random = reference::stream(2);
  int n_cut = 0, n_loops = 0;
  double worst = 0;
  for (const auto& shape : reference::cell_shapes()) {
    for (int n = 0; n < 40; ++n) {
      const Surface cell =
          reference::make_cell(shape, shared_icosphere(162), 15.1,
                               reference::random_rotation(random), Vec3(200, -100, 50));
      const auto plane = find_halving_plane(cell.node, cell.triangle, random.unit_vector());
      ASSERT_TRUE(plane);
      const Cut cut = cut_surface(cell.node, cell.triangle, *plane);
      if (cut.loop.size() != 1) {
        EXPECT_TRUE(cut.half[0].node.empty());
        ++n_loops;
        continue;
      }
      expect_halves(cell, *plane, cut, 1e-12);
      const double volume = compute_volume(cell.node, cell.triangle);
      const double below = compute_volume(cut.half[0].node, cut.half[0].triangle);
      const double above = compute_volume(cut.half[1].node, cut.half[1].triangle);
      worst = std::max(worst, std::abs(below - above) / volume);
      EXPECT_NEAR(below, above, 1e-9 * volume) << shape.name;
      ++n_cut;
    }
  }
  std::printf("%d cut, %d in several loops, halves differ by at most %.1e of the whole\n", n_cut,
              n_loops, worst);
  EXPECT_GE(n_cut, 200);
}

TEST(CutSurface, TakesNodesOnThePlaneAsAboveIt) {
  // Four nodes of this octahedron lie on its equator.
  Surface octahedron;
  octahedron.node = {Vec3::UnitX(),  Vec3::UnitY(), -Vec3::UnitX(),
                     -Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ()};
  octahedron.triangle = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                         {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  const CutPlane equator{Vec3::UnitZ(), 0};
  const Cut cut = cut_surface(octahedron.node, octahedron.triangle, equator);
  expect_halves(octahedron, equator, cut, 1e-15);
  EXPECT_NEAR(compute_volume(cut.half[0].node, cut.half[0].triangle), 2.0 / 3, 10 * kEps);
  const CutPlane tip{Vec3::UnitZ(), 1};  // a cut without area, and none
  expect_halves(octahedron, tip, cut_surface(octahedron.node, octahedron.triangle, tip), 1e-15);
  const CutPlane below_all{Vec3::UnitZ(), -1};
  EXPECT_TRUE(cut_surface(octahedron.node, octahedron.triangle, below_all).loop.empty());
  const Surface box = make_box(Vec3(1, 2, 3));
  const CutPlane diagonal{Vec3(2, -1, 0).normalized(), 0};  // through four nodes of the box
  expect_halves(box, diagonal, cut_surface(box.node, box.triangle, diagonal), 1e-15);
  const Surface sphere = make_sphere(162, 1);
  for (const Vec3& x :
       sphere.node) {  // a plane through two nodes and the centre, some more by luck
    const Vec3 normal = x.cross(sphere.node[7]);
    if (normal.norm() < 0.1) continue;
    const CutPlane plane{normal.normalized(), 0};
    expect_halves(sphere, plane, cut_surface(sphere.node, sphere.triangle, plane), 1e-14);
  }
}

TEST(CutSurface, RunsRoundTheNormal) {
  const Surface sphere = make_sphere(162, 1);
  const CutPlane plane{Vec3(1, 2, 3).normalized(), 0.3};
  const Cut cut = cut_surface(sphere.node, sphere.triangle, plane);
  ASSERT_EQ(cut.loop.size(), 1u);
  const auto& loop = cut.loop[0];
  double turned = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    turned += loop[k].cross(loop[(k + 1) % loop.size()]).dot(plane.normal);
  // Twice the cut's area. The mesh has l = 0.3 there and lies in by at most l^2 / 6 from the unit
  // sphere.
  EXPECT_NEAR(turned / (2 * kPi * (1 - 0.09)), 1, 0.04);
  const auto& half = cut.half[0];
  for (std::size_t t = half.triangle.size() - (loop.size() - 2); t < half.triangle.size(); ++t) {
    const auto& [a, b, c] = half.triangle[t];
    const Vec3& x = half.node[a];
    EXPECT_GE((half.node[b] - x).cross(half.node[c] - x).dot(plane.normal), -1e-15);
  }
}

TEST(CutSurface, CountsLoopsAndMakesNoHalvesThen) {
  const Surface torus = make_torus(24);
  const Cut across = cut_surface(torus.node, torus.triangle, {Vec3::UnitX(), 0.01});
  EXPECT_EQ(across.loop.size(), 2u);
  EXPECT_TRUE(across.half[0].triangle.empty());
  // A horseshoe, cut across both arms.
  const auto shapes = reference::cell_shapes();
  const Surface horseshoe = reference::make_cell(shapes.back(), shared_icosphere(642), 15.1,
                                                 Mat3::Identity(), Vec3::Zero());
  const Cut arms = cut_surface(horseshoe.node, horseshoe.triangle, {Vec3::UnitY(), 0});
  EXPECT_EQ(arms.loop.size(), 2u);
  EXPECT_TRUE(arms.half[1].triangle.empty());
}

TEST(CutSurface, RefusesARimThatEarClippingCannotTake) {
  Surface drum;  // a double cone over 300 corners, cut above its edge
  for (int k = 0; k < 300; ++k)
    drum.node.emplace_back(std::cos(2 * kPi * k / 300), std::sin(2 * kPi * k / 300), 0);
  drum.node.push_back(Vec3::UnitZ());
  drum.node.push_back(-Vec3::UnitZ());
  for (int k = 0; k < 300; ++k) {
    drum.triangle.push_back({k, (k + 1) % 300, 300});
    drum.triangle.push_back({(k + 1) % 300, k, 301});
  }
  EXPECT_THROW(cut_surface(drum.node, drum.triangle, {Vec3::UnitZ(), 0.5}), Error);
}

}  // namespace
}  // namespace acinus::geometry
