/// Fractions of voxels and faces inside spheres, surfaces and regions.

#include "substances/cover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/sphere.hpp"
#include "geometry/topology.hpp"
#include "substances/open_space.hpp"
#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

double sum_of(const std::vector<CoveredPart>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double sum, const CoveredPart& p) { return sum + p.fraction; });
}

/// Sum over the faces across an axis of the area of a ball's sections, in areas of a face.
double sections_of_ball(const VoxelGrid& g, int axis, const Vec3& center, double radius) {
  double sum = 0;
  for (int f = 0; f <= g.n[axis]; ++f) {
    const double height = g.low[axis] + f * g.spacing[axis] - center[axis];
    sum += std::max(0.0, kPi * (radius * radius - height * height));
  }
  return sum / (g.voxel_volume() / g.spacing[axis]);
}

/// Largest difference of two covers, each of whose parts is named once.
double difference(std::size_t n, const std::vector<CoveredPart>& a,
                  const std::vector<CoveredPart>& b) {
  std::vector<double> d(n, 0.0);
  for (const CoveredPart& p : a) d[p.at] += p.fraction;
  for (const CoveredPart& p : b) d[p.at] -= p.fraction;
  double largest = 0;
  for (const double x : d) largest = std::max(largest, std::abs(x));
  return largest;
}

const Vec3 kCenter(55.1, 61.7, 48.3);

VoxelGrid uneven_grid() { return make_grid({Vec3(-3, 2, 1), Vec3(117, 130, 110)}, 9.3); }

TEST(Cover, OfASphereHasItsVolumeAndSections) {
  const VoxelGrid g = uneven_grid();
  for (const double radius : {3.0, 9.0, 30.0}) {
    const Cover c = cover_sphere(g, kCenter, radius);
    EXPECT_NEAR(sum_of(c.volume) * g.voxel_volume(), sphere_volume(radius),
                2e-3 * sphere_volume(radius));
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(sum_of(c.face[axis]), sections_of_ball(g, axis, kCenter, radius),
                  1e-10 * sum_of(c.face[axis]));
    for (const CoveredPart& p : c.volume) EXPECT_LE(p.fraction, 1);
  }
}

TEST(Cover, OfASphereFillsTheVoxelsInItsMiddle) {
  const VoxelGrid g = cube(120, 24);
  const Cover c = cover_sphere(g, Vec3(61, 59, 60), 30);
  double largest = 0;
  for (const CoveredPart& p : c.volume)
    if (p.at == g.index(12, 12, 12)) largest = p.fraction;
  EXPECT_EQ(largest, 1);
}

TEST(Cover, CountsNothingOutsideTheBox) {
  const VoxelGrid g = cube(40, 4);
  const Cover c = cover_sphere(g, Vec3(0, 20, 20), 10);
  EXPECT_NEAR(sum_of(c.volume) * g.voxel_volume(), sphere_volume(10) / 2, 0.01 * sphere_volume(10));
  EXPECT_TRUE(cover_sphere(g, Vec3(-30, 20, 20), 10).volume.empty());
}

TEST(Cover, OfASurfaceIsThatOfItsInside) {
  const VoxelGrid g = uneven_grid();
  const geometry::Topology& t = geometry::shared_icosphere(2562);
  std::vector<Vec3> node;
  for (const Vec3& x : t.rest) node.push_back(kCenter + 30 * x);
  const Cover surface = cover_surface(g, node, t.triangle), ball = cover_sphere(g, kCenter, 30);
  // The mesh lies inside the ball, its volume 0.4 % less; lines are a quarter of a voxel apart.
  EXPECT_NEAR(sum_of(surface.volume), sum_of(ball.volume), 0.01 * sum_of(ball.volume));
  EXPECT_LT(difference(g.n_voxel(), surface.volume, ball.volume), 0.06);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum_of(surface.face[axis]), sum_of(ball.face[axis]),
                0.01 * sum_of(ball.face[axis]));
    // A face that the surface just touches has few lines in it.
    EXPECT_LT(difference(g.n_face(axis), surface.face[axis], ball.face[axis]), 0.12);
  }
}

TEST(Cover, OfABoxIsExact) {
  const VoxelGrid g = cube(40, 4);
  const Vec3 low(10, 10, 5), high(30, 20, 25);
  const auto& [node, triangle] = box_mesh(low, high);
  const Cover c = cover_surface(g, node, triangle);
  EXPECT_NEAR(sum_of(c.volume), 4, 1e-12);
  EXPECT_NEAR(sum_of(c.face[2]), 4, 1e-12);  // the planes z = 10 and 20
}

TEST(Cover, OfARegionIsWhereTheDistanceIsNegative) {
  const VoxelGrid g = uneven_grid();
  const Cover region = cover_region(g, [](const Vec3&x) { return (x - kCenter).norm() - 30; }),
              ball = cover_sphere(g, kCenter, 30);
  EXPECT_LT(difference(g.n_voxel(), region.volume, ball.volume), 0.01);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum_of(region.face[axis]), sum_of(ball.face[axis]), 0.01 * sum_of(ball.face[axis]));
    // Largest at a face that the surface just touches.
    EXPECT_LT(difference(g.n_face(axis), region.face[axis], ball.face[axis]), 0.08);
  }
}

TEST(OpenSpace, ClosedVoxelsHaveOpenOnesNearThem) {
  const VoxelGrid g = cube(120, 24);
  CoveredSpace covered(g);
  covered.add(cover_sphere(g, Vec3(61, 59, 60), 30));
  const OpenSpace space = covered.open(g);
  EXPECT_GT(space.closed.size(), 500U);
  for (std::size_t v = 0; v < g.n_voxel(); ++v) {
    EXPECT_GT(space.volume[space.nearest[v]], 0);
    EXPECT_EQ(space.layer[v] == 0, space.volume[v] > 0);
  }
  EXPECT_EQ(space.face[0][g.face_index(0, 12, 12, 12)], 0);
  EXPECT_EQ(space.face[0][g.face_index(0, 0, 12, 12)], 1);
}

TEST(OpenSpace, CarriesAmountsAndFillsValues) {
  const VoxelGrid g = cube(120, 24);
  CoveredSpace covered(g);
  covered.add(cover_sphere(g, Vec3(61, 59, 60), 30));
  const OpenSpace space = covered.open(g);
  std::vector<double> held(g.n_voxel(), 1.0);
  carry_amounts(space, held);
  EXPECT_NEAR(std::accumulate(held.begin(), held.end(), 0.0), static_cast<double>(g.n_voxel()),
              1e-9);
  for (const std::size_t v : space.closed) EXPECT_EQ(held[v], 0);
  std::vector<double> c = sample(g, [](const Vec3& x) { return 3 + 0.01 * x.x(); });
  for (const std::size_t v : space.closed) c[v] = -1e9;
  fill_closed(g, space, c);
  EXPECT_GE(*std::min_element(c.begin(), c.end()), 3);
  EXPECT_LE(*std::max_element(c.begin(), c.end()), 4.2);
}

}  // namespace
}  // namespace acinus::substances
