/// The paper's contact law between triangles against its closed form between spheres.

#include "core/contact/maugis_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "core/contact/maugis_overlap.hpp"
#include "core/mesh/topology.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRadius = 10;  // um, of each sphere; the reduced one is half of it

/// lambda = 1 with W = 0.01 nN/um: a range of 0.1 um that faces of 162 nodes hardly resolve.
MaugisPair soft_pair() {
  MaugisPair pair{{kRadius / 2, 0.5, 0.01}, 0.1};
  pair.cohesive_stress *= 1 / maugis_lambda(pair);
  return pair;
}

MaugisLaw law_of(const MaugisPair& p) {
  return {p.pair.modulus, p.pair.adhesion, p.cohesive_stress};
}

struct Ball {
  const mesh::Topology* mesh;
  std::vector<Vec3> node;
  std::vector<CurvedTriangle> curved;
  CurvedSurface view() const { return {mesh->n_node, mesh->triangle, curved}; }
};

Ball make_ball(int nodes, const Mat3& turn, const Vec3& center) {
  Ball b{&mesh::shared_icosphere(nodes), {}, {}};
  for (const Vec3& x : b.mesh->rest) b.node.push_back(kRadius * (turn * x.normalized()) + center);
  b.curved = make_curved_triangles(b.node, b.mesh->triangle);
  return b;
}

Vec3 sum_of(const std::vector<Vec3>& force) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : force) sum += f;
  return sum;
}

double size_of(const std::vector<Vec3>& force) {
  double size = 0;
  for (const Vec3& f : force) size += f.norm();
  return size;
}

TEST(MaugisOverlap, IsTheCurveByRadiusAskedTheOtherWay) {
  for (const double lambda : {0.05, 0.5, 1.0, 3.0, 20.0}) {
    MaugisPair pair = soft_pair();
    pair.cohesive_stress *= lambda;
    const MaugisCurve curve = make_maugis_curve(pair);
    EXPECT_NEAR(curve.lambda, lambda, 1e-12 * lambda);
    for (const double a : {1.1, 1.5, 2.5, 4.0}) {
      const MaugisPoint by_radius = maugis_at_radius(pair, a * (curve.least_radius + 0.3));
      if (by_radius.overlap < curve.contact_overlap) continue;
      const MaugisPoint by_overlap = maugis_at_overlap(curve, by_radius.overlap);
      EXPECT_NEAR(by_overlap.contact_radius, by_radius.contact_radius, 1e-7) << lambda << ' ' << a;
      // Near its fold the curve is flat: a relative 1e-8 of the force is what the root leaves.
      EXPECT_NEAR(by_overlap.force, by_radius.force, 1e-7 * std::abs(by_radius.force) + 1e-10);
    }
    EXPECT_EQ(maugis_at_overlap(curve, curve.least_overlap - 1e-9).force, 0);
  }
}

TEST(MaugisOverlap, MeetsTheStateApartWithoutAStep) {
  MaugisPair pair = soft_pair();
  pair.cohesive_stress *= 0.2;
  const MaugisCurve curve = make_maugis_curve(pair);
  ASSERT_EQ(curve.least_radius, 0);
  const double in = maugis_at_overlap(curve, curve.contact_overlap + 1e-9).force;
  const double out = maugis_at_overlap(curve, curve.contact_overlap - 1e-9).force;
  EXPECT_NEAR(in, out, 1e-6 * std::abs(in));
}

TEST(CurvedTriangle, SphereGoesThroughItsCorners) {
  auto random = reference::stream(3);
  for (int k = 0; k < 50; ++k) {
    const Vec3 a = reference::random_vector(random, 2), b = reference::random_vector(random, 2),
               c = reference::random_vector(random, 2);
    const CurvedTriangle t = make_curved_triangle({a, b, c}, 0.02);
    if (t.circumradius > 40) continue;
    const FittedSphere s = fit_sphere(t, std::min(0.02, 1 / t.circumradius));
    for (const Vec3& x : t.corner)
      EXPECT_NEAR((x - s.center).norm(), s.radius, 1e3 * kEps * (s.radius + t.circumradius));
    EXPECT_LE((s.center - t.circumcenter).dot(t.normal), 1e-12);
  }
}

TEST(CurvedTriangle, IcospheresHaveTheCurvatureOfTheirSphere) {
  for (const int nodes : {162, 642}) {
    const Ball b = make_ball(nodes, Mat3::Identity(), Vec3::Zero());
    for (const CurvedTriangle& t : b.curved) EXPECT_NEAR(t.curvature * kRadius, 1, 0.02) << nodes;
  }
}

/// Every pair's forces, two balls pressed together.
SurfaceForces press(const MaugisLaw& law, const Ball& a, const Ball& b) {
  return compute_surface_forces(law, a.view(), b.view(), 1);
}

TEST(MaugisTriangles, ForcesBalanceAndTurnWithTheBalls) {
  const MaugisLaw law = law_of(soft_pair());
  auto random = reference::stream(7);
  for (int k = 0; k < 5; ++k) {
    const Mat3 at_a = reference::random_rotation(random), at_b = reference::random_rotation(random),
               turn = reference::random_rotation(random);
    const Vec3 shift(3, -50, 8), apart(2 * kRadius - 0.3, 0, 0);
    const Ball a = make_ball(162, at_a, Vec3::Zero()), b = make_ball(162, at_b, apart);
    const SurfaceForces f = press(law, a, b);
    const double size = size_of(f.on_a);
    ASSERT_GT(size, 0);
    EXPECT_LT((sum_of(f.on_a) + sum_of(f.on_b)).norm(), 1e-12 * size);
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < a.node.size(); ++i)
      moment += a.node[i].cross(f.on_a[i]) + b.node[i].cross(f.on_b[i]);
    // Force and counterforce stand on the flat faces, whose gap along the normal does not matter;
    // across it they are at one place of the contact plane.
    EXPECT_LT(moment.norm(), 1e-11 * size * 2 * kRadius);
    const Ball c = make_ball(162, turn * at_a, shift),
               d = make_ball(162, turn * at_b, turn * apart + shift);
    const SurfaceForces g = press(law, c, d);
    for (std::size_t i = 0; i < a.node.size(); ++i)
      EXPECT_LT((turn * f.on_a[i] - g.on_a[i]).norm(), 1e-9 * size);
  }
}

TEST(MaugisTriangles, NothingIsLeftFarApart) {
  const Ball a = make_ball(162, Mat3::Identity(), Vec3::Zero()),
             b = make_ball(162, Mat3::Identity(), Vec3(2 * kRadius + 1, 0, 0));
  const SurfaceForces f = press(law_of(soft_pair()), a, b);
  EXPECT_EQ(size_of(f.on_a), 0);
  EXPECT_EQ(f.contact_area, 0);
}

struct Scatter {
  double mean = 0, deviation = 0;
};

/// Force of two balls over that of spheres, at one overlap, over random directions.
Scatter ratio_at(int nodes, double overlap, int n) {
  const MaugisPair pair = soft_pair();
  const double exact = maugis_at_overlap(make_maugis_curve(pair), overlap).force;
  auto random = reference::stream(11);
  double sum = 0, squares = 0;
  for (int k = 0; k < n; ++k) {
    const Mat3 at_a = reference::random_rotation(random), at_b = reference::random_rotation(random);
    const Ball a = make_ball(nodes, at_a, Vec3::Zero()),
               b = make_ball(nodes, at_b, Vec3(2 * kRadius - overlap, 0, 0));
    const double ratio = -sum_of(press(law_of(pair), a, b).on_a).x() / exact;
    sum += ratio;
    squares += ratio * ratio;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) * n / (n - 1))};
}

// Balls whose every triangle knows the sphere it stands for: what is left is the area that is cut
// at the rim. A mean over n directions is known to deviation / sqrt(n), four of which are allowed,
// and with faces of a third of the contact radius or more a hundredth is lost to six points.
TEST(MaugisTriangles, ComeNearTheClosedFormAsFacesBecomeSmall) {
  for (const double overlap : {-0.02, 0.0, 0.3, 1.0}) {
    const Scatter coarse = ratio_at(162, overlap, 12), fine = ratio_at(642, overlap, 6);
    std::printf("overlap %5.2f um: 162 nodes %.3f +- %.3f, 642 nodes %.3f +- %.3f of spheres\n",
                overlap, coarse.mean, coarse.deviation, fine.mean, fine.deviation);
    EXPECT_NEAR(coarse.mean, 1, 0.01 + 4 * coarse.deviation / std::sqrt(12)) << overlap;
    EXPECT_NEAR(fine.mean, 1, 0.01 + 4 * fine.deviation / std::sqrt(6)) << overlap;
    EXPECT_LT(fine.deviation, 0.6 * coarse.deviation) << overlap;
  }
}

}  // namespace
}  // namespace acinus::contact
