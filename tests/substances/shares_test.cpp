/// Shares of spheres and surfaces in voxels.

#include "substances/shares.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sphere.hpp"
#include "geometry/topology.hpp"
#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

double volume_of(const std::vector<VoxelShare>& shares) {
  double sum = 0;
  for (const VoxelShare& s : shares) sum += s.volume;
  return sum;
}

Vec3 middle_of(const VoxelGrid& g, const std::vector<VoxelShare>& shares) {
  Vec3 sum = Vec3::Zero();
  for (const VoxelShare& s : shares) {
    const auto v = static_cast<int>(s.voxel);
    sum += s.volume * g.center(v % g.n[0], v / g.n[0] % g.n[1], v / (g.n[0] * g.n[1]));
  }
  return sum / volume_of(shares);
}

/// Nodes of an icosphere of radius r about a centre.
std::vector<Vec3> ball_nodes(const geometry::Topology& t, const Vec3& center, double r) {
  std::vector<Vec3> node;
  for (const Vec3& x : t.rest) node.push_back(center + r * x);
  return node;
}

TEST(Shares, OfASphereAreItsVolumeAndPlace) {
  const VoxelGrid g = cube(120, 12);
  for (const Vec3& center : {Vec3(60, 60, 60), Vec3(51.3, 67.9, 44.2), Vec3(30, 35, 40)}) {
    const std::vector<VoxelShare> shares = share_sphere(g, center, 12);
    EXPECT_NEAR(volume_of(shares), sphere_volume(12), 1e-9);
    // Columns a third of a voxel apart leave an error of a few per cent of it.
    EXPECT_LT((middle_of(g, shares) - center).norm(), 0.5);
    for (const VoxelShare& s : shares) EXPECT_LE(s.volume, 1.06 * g.voxel_volume());
  }
}

TEST(Shares, OfASurfaceAreThoseOfItsInside) {
  const VoxelGrid g = cube(120, 15);
  const geometry::Topology& t = geometry::shared_icosphere(642);
  const Vec3 center(55.1, 61.7, 48.3);
  const std::vector<Vec3> node = ball_nodes(t, center, 20);
  const std::vector<VoxelShare> surface = share_surface(g, node, t.triangle);
  const double inside = volume_of(surface);
  EXPECT_NEAR(inside, sphere_volume(20), 0.02 * sphere_volume(20));  // chords lie inside the ball
  const std::vector<VoxelShare> ball = share_sphere(g, center, 20);
  double difference = 0;
  std::vector<double> of_voxel(g.n_voxel(), 0.0);
  for (const VoxelShare& s : ball) of_voxel[s.voxel] += s.volume;
  for (const VoxelShare& s : surface) of_voxel[s.voxel] -= s.volume;
  for (const double d : of_voxel) difference += std::abs(d);
  EXPECT_LT(difference, 0.04 * inside);
}

TEST(Shares, OfABoxWithEdgesOnColumnsAreExact) {
  // Every edge of the mesh lies on vertical planes that columns may hit.
  const VoxelGrid g = cube(40, 4);
  const Vec3 low(10, 10, 5), high(30, 20, 25);
  const auto& [node, triangle] = box_mesh(low, high);
  const std::vector<VoxelShare> shares = share_surface(g, node, triangle);
  EXPECT_NEAR(volume_of(shares), 20 * 10 * 20, 1e-9);
  EXPECT_EQ(shares.size(), 6U);
  for (const VoxelShare& s : shares) {
    const bool whole = s.voxel / 16 == 1;  // the middle layer
    EXPECT_NEAR(s.volume, whole ? 1000 : 500, 1e-9);
  }
}

TEST(Shares, OutsideTheBoxCountInTheNearestVoxel) {
  const VoxelGrid g = cube(40, 4);
  const std::vector<VoxelShare> shares = share_sphere(g, Vec3(-100, 15, 15), 3);
  EXPECT_NEAR(volume_of(shares), sphere_volume(3), 1e-9);
  for (const VoxelShare& s : shares) EXPECT_EQ(s.voxel % 4, 0U);
}

TEST(Shares, OfASmallBodyAreInOneVoxel) {
  const VoxelGrid g = cube(40, 4);
  const std::vector<VoxelShare> shares = share_sphere(g, Vec3(15, 25, 35), 0.01);
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares[0].voxel, g.index(1, 2, 3));
}

TEST(Shares, MeanIsWeightedByVolume) {
  const std::vector<double> field{1, 5};
  EXPECT_DOUBLE_EQ(mean_over(std::vector<VoxelShare>{{0, 3}, {1, 1}}, field), 2);
}

}  // namespace
}  // namespace acinus::substances
