#include "imaging/label_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sphere.hpp"
#include "geometry/closed.hpp"
#include "geometry/measures.hpp"
#include "tests/imaging/images.hpp"

namespace acinus::imaging {
namespace {

LabelSurface surface_of(const LabelImage& image, double edge) {
  const LabelRows rows = make_rows(image);
  const Pieces pieces = find_pieces(rows);
  return make_label_surface(rows, pieces.piece.front(), edge, 0.7);
}

TEST(LabelSurface, OfABallIsABallOfTheVolumeOfItsVoxels) {
  const Vec3 middle(10.3, 9.8, 10.1);
  const double radius = 7;
  for (const Vec3& voxel : {Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 1.5)}) {
    const Voxel size{40, 40, static_cast<int>(std::lround(20 / voxel[2]))};
    const LabelImage image = make_image(
        size, voxel, [&](const Vec3& x) { return Label((x - middle).norm() < radius ? 5 : 0); });
    const LabelSurface s = surface_of(image, 0.7);
    EXPECT_NO_THROW(geometry::check_manifold(s.surface, "ball"));
    EXPECT_EQ(s.handles, 0);
    EXPECT_EQ(s.left_out, 0);
    const double volume = geometry::compute_volume(s.surface.node, s.surface.triangle);
    EXPECT_NEAR(volume, s.volume, 1e-12 * s.volume);
    EXPECT_NEAR(s.volume, sphere_volume(radius), 0.01 * sphere_volume(radius));
    EXPECT_LT((geometry::compute_centroid(s.surface.node, s.surface.triangle) - middle).norm(),
              0.1 * voxel.maxCoeff());
    double square = 0;
    for (const Vec3& x : s.surface.node) square += std::pow((x - middle).norm() - radius, 2);
    EXPECT_LT(std::sqrt(square / s.surface.node.size()), 0.25 * voxel.maxCoeff());
  }
}

TEST(LabelSurface, CountsHolesAndPartsThatHangByAVoxel) {
  const LabelImage ring = make_image({40, 40, 16}, Vec3::Ones(), [](const Vec3& x) {
    const double around = std::hypot(x[0] - 20, x[1] - 20) - 12;
    return Label(std::hypot(around, x[2] - 8) < 4 ? 1 : 0);
  });
  EXPECT_EQ(surface_of(ring, 1).handles, 1);
  const LabelImage twins = make_image({40, 20, 20}, Vec3::Ones(), [](const Vec3& x) {
    const bool ball = (x - Vec3(10, 10, 10)).norm() < 7 || (x - Vec3(30, 10, 10)).norm() < 5;
    return Label(ball || (std::abs(x[1] - 10.5) < 0.2 && std::abs(x[2] - 10.5) < 0.2 && x[0] > 10 &&
                          x[0] < 30)
                     ? 1
                     : 0);
  });
  const LabelSurface s = surface_of(twins, 1);
  EXPECT_NEAR(s.left_out, sphere_volume(5), 0.1 * sphere_volume(5));
}

TEST(LabelSurface, EndsAtTheBorderOfTheImage) {
  const LabelImage image = make_image({20, 20, 10}, Vec3::Ones(), [](const Vec3& x) {
    return Label((x - Vec3(10, 10, 0)).norm() < 7 ? 1 : 0);
  });
  const LabelSurface s = surface_of(image, 1);
  double lowest = 0;
  for (const Vec3& x : s.surface.node) lowest = std::min(lowest, x[2]);
  EXPECT_GT(lowest, -0.5);
  EXPECT_NEAR(geometry::compute_volume(s.surface.node, s.surface.triangle), s.volume,
              1e-12 * s.volume);
}

}  // namespace
}  // namespace acinus::imaging
