/// Single triangles against objects: hollow ones, and partners that yield.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "contact/maugis_triangles.hpp"

namespace acinus::contact {
namespace {

/// Sphere that stands for a sinusoid of 4.7 um, and modulus of its wall.
constexpr double kBall = 9.4, kWall = 0.6 / 0.84;
/// Side of a triangle of a cell of 162 nodes.
constexpr double kSide = 3.6;

/// Equilateral triangle whose middle is `depth` deep in a ball about the origin, below its top. It
/// faces down but for a turn by `tilt`.
CurvedTriangle triangle_in_ball(double curvature, double depth, double tilt) {
  std::array<Vec3, 3> corner;
  const Mat3 turn = Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    const double angle = 0.4 - k * 2 * kPi / 3;
    corner[k] = Vec3(0, 0, kBall - depth) +
                turn * Vec3(std::cos(angle), std::sin(angle), 0) * kSide / std::sqrt(3.0);
  }
  return make_curved_triangle(corner, curvature);
}

TrianglePart push_in_ball(const MaugisLaw& law, double curvature, double depth, double tilt) {
  return compute_object_contact(law, triangle_in_ball(curvature, depth, tilt),
                                {Vec3(0, 0, kBall), Vec3::UnitZ(), 0, 1 / kBall})
      .push;
}

// A cell that closes about a thin vessel is hollow there, and its triangles are not quite parallel
// to the vessel. With R^ of up to 1 mm the two spheres would overlap far beside the triangle. Of a
// flat one turned by 0.3, 1 um deep, the middle has 0.85 of the stress without a turn.
TEST(MaugisObjects, PushHollowTrianglesAsFlatOnes) {
  const MaugisLaw law = {10, 0, 0};
  for (const double depth : {1.0, 1.5, 2.5}) {
    const double straight = push_in_ball(law, 0, depth, 0).force;
    for (const double tilt : {0.0, 0.15, 0.3}) {
      const double flat = push_in_ball(law, 0, depth, tilt).force;
      EXPECT_GT(flat, 0.7 * straight) << depth << " um deep, turned by " << tilt;
      for (const double curvature : {-0.03, -0.08, -0.1, -0.15})
        EXPECT_DOUBLE_EQ(push_in_ball(law, curvature, depth, tilt).force, flat)
            << depth << " um deep, turned by " << tilt << ", curvature " << curvature;
    }
  }
}

// Before and behind the plane no force jumps: R^ changes by 1e-3, the force of Hertz by half of it.
TEST(MaugisObjects, PushWithoutAJumpWhereACurvatureChangesItsSign) {
  const MaugisLaw law = {10, 0, 0};
  double before = push_in_ball(law, -1e-4, 1, 0.2).force;
  for (double curvature = -1e-4; curvature <= 1e-4; curvature += 5e-7) {
    const double now = push_in_ball(law, curvature, 1, 0.2).force;
    EXPECT_NEAR(now, before, 1e-5 * before) << curvature;
    before = now;
  }
}

// A mesh of the object serves as the object itself where it bulges, and as a cell where it is
// hollow.
TEST(MaugisObjects, CountAlikeAsMeshes) {
  const MaugisLaw law = {10, 0, 0};
  const auto facing_up = [](double curvature) {
    std::array<Vec3, 3> corner;
    for (int k = 0; k < 3; ++k)
      corner[k] = Vec3(3 * std::cos(2 * kPi * k / 3), 3 * std::sin(2 * kPi * k / 3), 0);
    return make_curved_triangle(corner, curvature);
  };
  const double low = std::sqrt(kBall * kBall - 9);  // of the mesh below the middle of the ball
  CurvedTriangle hollow = triangle_in_ball(-0.1, 1.5, 0.3), flat = triangle_in_ball(0, 1.5, 0.3);
  for (CurvedTriangle* t : {&hollow, &flat}) {
    for (Vec3& x : t->corner) x.z() -= low;
    t->circumcenter.z() -= low;
  }
  const CurvedTriangle bulging = facing_up(1 / kBall), cavity = facing_up(-0.05);
  const double mesh = compute_triangle_contact(law, hollow, bulging, CapOf::kObjectMesh).push.force;
  EXPECT_DOUBLE_EQ(mesh,
                   compute_triangle_contact(law, flat, bulging, CapOf::kObjectMesh).push.force);
  EXPECT_GT(mesh, 0);
  EXPECT_DOUBLE_EQ(compute_triangle_contact(law, hollow, cavity, CapOf::kObjectMesh).push.force,
                   compute_triangle_contact(law, hollow, cavity).push.force);
}

TEST(MaugisObjects, YieldByNoMoreThanTheirLimit) {
  MaugisLaw law = {10, 0, 0};
  EXPECT_EQ(modulus_at(law, 3), 10) << "rigid";
  law.partner_modulus = kWall;
  const double series = 1 / (0.1 + 1 / kWall);
  EXPECT_DOUBLE_EQ(modulus_at(law, 3), series);
  EXPECT_DOUBLE_EQ(modulus_at(law, -1), series);
  law.most_yield = 0.15 * 4.7;
  // The wall takes the share series/kWall of the overlap, up to its limit.
  const double onset = law.most_yield * kWall / series;
  EXPECT_DOUBLE_EQ(modulus_at(law, 0.999 * onset), series);
  EXPECT_NEAR(modulus_at(law, 1.001 * onset), series, 0.01);
  EXPECT_DOUBLE_EQ(modulus_at(law, 2), 10 * (1 - law.most_yield / 2));
  // With Hertz p = (2 E/pi) sqrt(delta/R): as a rigid wall that stands 0.705 um back.
  EXPECT_NEAR(modulus_at(law, 2) * 2, 10 * (2 - law.most_yield), 1e-12);
}

// In the middle of a contact the force on a triangle by its depth, on both sides of the limit.
TEST(MaugisObjects, SlopeFollowsTheForceBeyondTheLimit) {
  MaugisLaw law = {10, 0, 0};
  law.partner_modulus = kWall;
  law.most_yield = 0.15 * 4.7;
  const double deeper = 0.005;
  double before = 0;
  for (double depth = 0.5; depth < 2.5; depth += 0.01) {
    const TrianglePart now = push_in_ball(law, 0, depth, 0);
    const double then = push_in_ball(law, 0, depth + deeper, 0).force;
    EXPECT_NEAR(now.slope, (then - now.force) / deeper, 0.03 * now.slope) << depth;
    EXPECT_GT(now.force, before);
    before = now.force;
  }
}

}  // namespace
}  // namespace acinus::contact
