#include "dcm/shape/available_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dcm/shape/cast.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::dcm {
namespace {

constexpr double kBallRadius = 12;  // um
const geometry::Topology& fine_icosphere = geometry::shared_icosphere(642);

std::vector<Vec3> directions(const Mat3& rotation) {
  std::vector<Vec3> direction;
  for (const Vec3& rest : fine_icosphere.rest) direction.push_back((rotation * rest).normalized());
  return direction;
}

/// Volume of a ball below a plane at a distance h above its centre.
double ball_below(double r, double h) {
  return kPi * (2 * r * r * r / 3 + h * r * r - h * h * h / 3);
}

TEST(AvailableVolume, TheFaceBetweenTwoBallsIsTheirCircle) {
  const double a = 12, b = 9, distance = 16;
  const double share = share_of_distance(a, b, distance);
  // Both balls have the same circle in that plane.
  EXPECT_NEAR(a * a - std::pow(share * distance, 2), b * b - std::pow((1 - share) * distance, 2),
              1e-12 * a * a);
  EXPECT_NEAR(share + share_of_distance(b, a, distance), 1, 1e-15);
  // A ball that holds the other's centre leaves it a quarter of the distance.
  EXPECT_EQ(share_of_distance(20, 6, 10), 0.75);
  EXPECT_EQ(share_of_distance(6, 20, 10), 0.25);
}

AvailableVolume make_volume(const Vec3& center, std::span<const VolumeFace> face) {
  return {center, [face](const Vec3& d) { return reach_to_faces(d, 2 * kBallRadius, face); }};
}

TEST(AvailableVolume, WithoutFacesIsTheBall) {
  const AvailableVolume available = make_volume(Vec3::Zero(), {});
  const auto node = available.fill(fine_icosphere, directions(Mat3::Identity()), {kBallRadius});
  for (const Vec3& x : node)
    EXPECT_NEAR(x.norm(), kBallRadius, 1e-2);  // spread over faces of 642 nodes
}

TEST(AvailableVolume, IsAsLargeAsAsked) {
  const VolumeFace face{Vec3(0, 0, 1), 6};
  const AvailableVolume available = make_volume(Vec3(1, 2, 3), std::span(&face, 1));
  const double wanted = 4.0 / 3 * kPi * std::pow(kBallRadius, 3);
  const double radius = available.find_radius(wanted, 2 * kBallRadius);
  EXPECT_GT(radius, kBallRadius);
  EXPECT_NEAR(available.volume({radius}) / wanted, 1, 1e-9);
  EXPECT_EQ(available.find_radius(10 * wanted, 1.5 * kBallRadius), 1.5 * kBallRadius);
}

TEST(AvailableVolume, ABallCutByAPlaneHasItsVolumeAndStaysBelow) {
  auto random = reference::stream(5);
  for (const double height : {10.0, 6.0, 3.0}) {
    const Mat3 turn = reference::random_rotation(random);
    const VolumeFace face{turn * Vec3(0, 0, 1), height};
    const Vec3 center(3, -4, 5);
    const auto node = make_volume(center, std::span(&face, 1))
                          .fill(fine_icosphere, directions(turn), {kBallRadius});
    for (const Vec3& x : node) {
      EXPECT_LE(face.normal.dot(x - center), height + 1e-9);
      EXPECT_LE((x - center).norm(), kBallRadius * (1 + 1e-12));
    }
    // The chords of 642 nodes lose 1 % of a ball.
    const double volume = geometry::compute_volume(node, fine_icosphere.triangle);
    EXPECT_NEAR(volume / ball_below(kBallRadius, height), 0.985, 0.015) << height;
    EXPECT_TRUE(faces_outward(fine_icosphere, node, center));
  }
}

TEST(AvailableVolume, AMovedBallPutsTheCentroidAtTheCentre) {
  auto random = reference::stream(11);
  const double wanted = 0.9 * ball_below(kBallRadius, kBallRadius);
  for (const int faces : {0, 1, 3, 5}) {
    std::vector<VolumeFace> face;
    for (int k = 0; k < faces; ++k)
      face.push_back({reference::random_vector(random, 1).normalized(), 0.85 * kBallRadius});
    const Vec3 center(1, 2, 3);
    const AvailableVolume available = make_volume(center, face);
    const CuttingBall ball = available.find_ball(wanted, 1.6 * kBallRadius);
    const CuttingBall central{available.find_radius(wanted, 1.6 * kBallRadius)};
    EXPECT_NEAR(available.volume(ball) / wanted, 1, 1e-9) << faces;
    const auto shift = [&](const CuttingBall& b) {
      const auto node = available.fill(fine_icosphere, directions(Mat3::Identity()), b);
      return (geometry::compute_centroid(node, fine_icosphere.triangle) - center).norm();
    };
    EXPECT_LT(shift(ball), 0.004 * kBallRadius) << faces;
    if (faces == 1) {
      EXPECT_GT(shift(central), 0.01 * kBallRadius);
    }
  }
}

TEST(AvailableVolume, MeshesOfNarrowOnesAreSound) {
  auto random = reference::stream(7);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<VolumeFace> face;
    const int n = 1 + trial % 14;
    for (int k = 0; k < n; ++k)
      face.push_back(
          {reference::random_vector(random, 1).normalized(),
           kBallRadius * (0.15 + 0.8 * std::abs(reference::random_vector(random, 1).x()))});
    const auto node = make_volume(Vec3::Zero(), face)
                          .fill(fine_icosphere, directions(Mat3::Identity()), {kBallRadius});
    for (const Vec3& x : node)
      for (const VolumeFace& f : face) EXPECT_LE(f.normal.dot(x), f.distance + 1e-9);
    EXPECT_TRUE(faces_outward(fine_icosphere, node, Vec3::Zero())) << trial;
    EXPECT_FALSE(geometry::AuditBody(node, fine_icosphere.triangle).self_intersects()) << trial;
    EXPECT_GT(geometry::compute_quality(node, fine_icosphere.triangle), 0.02) << trial;
  }
}

}  // namespace
}  // namespace acinus::dcm
