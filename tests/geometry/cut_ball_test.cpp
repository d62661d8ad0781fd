/// Balls cut by planes against formulas, and areas as derivatives of the volume.

#include "geometry/cut_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/sphere.hpp"

namespace acinus::geometry {
namespace {

/// Some tens of sums of numbers of order one.
constexpr double kRounding = 1e-13;

std::vector<BallCut> box_planes(const Vec3& low, const Vec3& high) {
  std::vector<BallCut> planes;
  for (int m = 0; m < 3; ++m) {
    planes.push_back({Vec3::Unit(m), high[m]});
    planes.push_back({-Vec3::Unit(m), -low[m]});
  }
  return planes;
}

std::vector<BallCut> oblique() {
  std::vector<BallCut> planes;
  for (const Vec3& p :
       {Vec3(1, 0.2, 0.1), Vec3(-0.3, 1, 0.2), Vec3(0.1, -0.9, 0.4), Vec3(-1, -0.3, 0.1),
        Vec3(0.2, 0.1, 1), Vec3(0.3, 0.2, -1.1), Vec3(1, 1, 1)})
    planes.push_back({p.normalized(), 0.55 + 0.1 * p.x()});
  planes.push_back({Vec3(0.5, -1, -0.8).normalized(), -0.1});  // the middle is cut off
  return planes;
}

TEST(CutBall, WithoutPlanesIsABall) {
  EXPECT_NEAR(cut_ball(2, {}).volume, sphere_volume(2), kRounding * sphere_volume(2));
  const std::vector<BallCut> far{{Vec3::UnitX(), 2.5}};
  EXPECT_NEAR(cut_ball(2, far).volume, sphere_volume(2), kRounding * sphere_volume(2));
  EXPECT_EQ(cut_ball(2, far).face[0].area, 0);
}

TEST(CutBall, LosesACap) {
  for (const double h : {0.7, 0.0, -0.4}) {
    const CutBall b = cut_ball(1, std::vector<BallCut>{{Vec3(1, 2, 2) / 3, h}});
    const double cap = kPi / 3 * (1 - h) * (1 - h) * (2 + h);
    EXPECT_NEAR(b.volume, sphere_volume(1) - cap, 10 * kRounding);
    EXPECT_NEAR(b.face[0].area, kPi * (1 - h * h), 10 * kRounding);
    EXPECT_NEAR((b.face[0].middle - h * Vec3(1, 2, 2) / 3).norm(), 0, kRounding);
  }
  EXPECT_EQ(cut_ball(1, std::vector<BallCut>{{Vec3::UnitX(), -1}}).volume, 0);
}

TEST(CutBall, IsTheBoxInsideIt) {
  const Vec3 low(-1, -0.5, 0.25), high(0.5, 1, 1.5);  // the middle of the ball is outside
  const CutBall b = cut_ball(10, box_planes(low, high));
  const Vec3 size = high - low;
  EXPECT_NEAR(b.volume, size.prod(), 1e3 * kRounding) << "differences of 10^3";
  EXPECT_NEAR(b.face[0].area, size.y() * size.z(), 10 * kRounding);
  EXPECT_NEAR((b.face[0].middle - Vec3(high.x(), 0.25, 0.875)).norm(), 0, 10 * kRounding);
}

TEST(CutBall, LosesSixCapsInAWideCube) {
  const double h = 0.9;  // caps that do not meet
  const CutBall b = cut_ball(1, box_planes(Vec3::Constant(-h), Vec3::Constant(h)));
  EXPECT_NEAR(b.volume, sphere_volume(1) - 6 * kPi / 3 * (1 - h) * (1 - h) * (2 + h),
              10 * kRounding);
}

TEST(CutBall, OfTwoEqualPlanesOneHasTheFace) {
  const std::vector<BallCut> twice{{Vec3::UnitX(), 0.5}, {Vec3::UnitX(), 0.5}};
  const CutBall b = cut_ball(1, twice);
  EXPECT_NEAR(b.face[0].area + b.face[1].area, kPi * 0.75, 10 * kRounding);
  EXPECT_NEAR(b.volume, cut_ball(1, std::span(twice).first(1)).volume, 10 * kRounding);
}

TEST(CutBall, AreasAreDerivativesOfTheVolume) {
  const std::vector<BallCut> planes = oblique();
  const CutBall b = cut_ball(1, planes);
  constexpr double kStep = 1e-5;
  int cut = 0;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    std::vector<BallCut> more = planes, less = planes;
    more[k].distance += kStep;
    less[k].distance -= kStep;
    const double slope = (cut_ball(1, more).volume - cut_ball(1, less).volume) / (2 * kStep);
    // Third derivative times step^2, and rounding over the step: 1e-10 each.
    EXPECT_NEAR(b.face[k].area, slope, 1e-9) << k;
    cut += b.face[k].area > 0 ? 1 : 0;
  }
  EXPECT_GE(cut, 5);
}

TEST(CutBall, DoesNotDependOnTheFrame) {
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  std::vector<BallCut> turned = oblique();
  for (BallCut& p : turned) p.normal = turn * p.normal;
  const CutBall a = cut_ball(1, oblique()), b = cut_ball(1, turned);
  EXPECT_NEAR(a.volume, b.volume, 10 * kRounding);
  for (std::size_t k = 0; k < turned.size(); ++k)
    EXPECT_NEAR((turn * a.face[k].middle - b.face[k].middle).norm(), 0, 100 * kRounding);
}

}  // namespace
}  // namespace acinus::geometry
