#include "contact/maugis_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/maugis_overlap.hpp"
#include "tests/contact/maugis_spheres.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

using test::kModuli, test::pair_of;

MaugisStress stress_of(double modulus, double overlap) {
  return make_maugis_stress(pair_of(modulus), maugis_at_overlap(pair_of(modulus), overlap));
}

StressParts integrate(const MaugisStress& s, std::span<const Vec2> polygon) {
  return integrate_stress(s, s, polygon);
}

double cross(const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); }

/// Integral over a triangle by halving: midpoints of edges, exact to degree 2, on 4^level parts.
struct Sum {
  double push = 0, pull = 0, push_area = 0, pull_area = 0;
  Vec2 moment = Vec2::Zero();
};
void add_by_halving(const MaugisStress& s, const std::array<Vec2, 3>& t, int level, Sum& out) {
  std::array<Vec2, 3> m;
  for (int k = 0; k < 3; ++k) m[k] = 0.5 * (t[k] + t[(k + 1) % 3]);
  if (level > 0) {
    for (int k = 0; k < 3; ++k) add_by_halving(s, {t[k], m[k], m[(k + 2) % 3]}, level - 1, out);
    return add_by_halving(s, m, level - 1, out);
  }
  const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]) / 3;
  for (const Vec2& x : m) {
    const double p = stress_at(s, x.norm());
    (p > 0 ? out.push : out.pull) += area * p;
    if (p != 0) (p > 0 ? out.push_area : out.pull_area) += area;
    out.moment += area * p * x;
  }
}

// A square around the whole contact: Eq. (14) and (17) integrate to the force of the curve.
TEST(MaugisStress, OverTheWholeContactIsTheForceOfTheCurve) {
  double worst = 0;
  for (const double modulus : kModuli)
    for (const double overlap : {least_overlap(pair_of(modulus)) + 1e-4, 0.05, 0.5}) {
      const MaugisPoint state = maugis_at_overlap(pair_of(modulus), overlap);
      const MaugisStress s = make_maugis_stress(pair_of(modulus), state);
      for (const double way : {0.0, 0.3, 0.9}) {  // a corner of the square within the contact
        const double far = 3 * state.cohesive_radius, shift = way * state.cohesive_radius;
        const std::array<Vec2, 4> square = {Vec2(-far, -far), Vec2(far, -far), Vec2(far, far),
                                            Vec2(-far, far)};
        StressParts sum;
        for (const Vec2& quadrant : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
          std::array<Vec2, 4> part = square;
          for (Vec2& x : part)
            for (int k = 0; k < 2; ++k) x[k] = x[k] * quadrant[k] > 0 ? x[k] : shift;
          const StressParts f = integrate(s, part);
          sum.push.force += f.push.force;
          sum.pull.force += f.pull.force;
          sum.push.area += f.push.area;
          sum.pull.area += f.pull.area;
          sum.push.moment += f.push.moment + f.pull.moment;
        }
        const double size = sum.push.force - sum.pull.force;
        worst = std::max(worst, std::abs(sum.push.force + sum.pull.force - state.force) / size);
        EXPECT_NEAR(sum.push.force + sum.pull.force, state.force, 1e-8 * size)
            << modulus << " " << overlap << " " << way;
        const double disc = kPi * state.cohesive_radius * state.cohesive_radius;
        EXPECT_NEAR(sum.push.area + sum.pull.area, disc, 1e-12 * disc);
        EXPECT_LT(sum.push.moment.norm(), 1e-8 * size * state.cohesive_radius);
      }
    }
  std::printf("whole contacts against the curve: %.1e\n", worst);
}

TEST(MaugisStress, OverTrianglesIsTheSumOfSmallOnes) {
  auto random = reference::stream(31);
  double worst = 0;
  int both = 0;
  for (int k = 0; k < 60; ++k) {
    const MaugisStress s = stress_of(kModuli[k % 4], random.uniform(0.0, 0.4));
    std::array<Vec2, 3> t;
    for (Vec2& x : t) x = s.c * Vec2(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    if (cross(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
    Sum sum;
    add_by_halving(s, t, 9, sum);
    const StressParts f = integrate(s, t);
    // Small triangles at the rim take it for one side or the other. They are 2^-9 of an edge of up
    // to 4 c: a strip of 2 pi c 2^-7 c with the stress sigma0, of which a fortieth is left over.
    const double size = sum.push - sum.pull + s.cohesive * s.c * s.c, tolerance = 1e-3;
    EXPECT_NEAR(f.push.force, sum.push, tolerance * size) << k;
    EXPECT_NEAR(f.pull.force, sum.pull, tolerance * size) << k;
    EXPECT_NEAR(f.push.area, sum.push_area, 2e-3 * s.c * s.c) << k;
    EXPECT_NEAR(f.pull.area, sum.pull_area, 2e-3 * s.c * s.c) << k;
    EXPECT_LT((f.push.moment + f.pull.moment - sum.moment).norm(), tolerance * size * s.c) << k;
    worst = std::max(worst, std::abs(f.push.force + f.pull.force - sum.push - sum.pull) / size);
    both += sum.push > 0 && sum.pull < 0 ? 1 : 0;
  }
  EXPECT_GT(both, 20);
  std::printf("triangles against small ones: %.1e\n", worst);
}

// Cut into two along a line anywhere, the parts add up: also where it runs through the contact
// point.
TEST(MaugisStress, PartsOfAPolygonAddUp) {
  auto random = reference::stream(32);
  for (int k = 0; k < 200; ++k) {
    const MaugisStress s = stress_of(kModuli[k % 4], random.uniform(-0.01, 0.4));
    std::array<Vec2, 3> t;
    for (Vec2& x : t) x = 2 * s.c * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    if (k % 5 == 0) t[2] = -0.7 * t[0];  // the edge between them meets the contact point
    if (cross(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
    const Vec2 cut = k % 3 == 0 ? Vec2::Zero() : Vec2(t[1] + 0.4 * (t[2] - t[1]));
    if (k % 3 == 0 && cross(t[1] - t[0], t[2] - t[0]) > 0) continue;
    const StressParts whole = integrate(s, t);
    const std::array<Vec2, 3> left = {t[0], t[1], cut}, right = {t[0], cut, t[2]};
    const StressParts f = integrate(s, left), g = integrate(s, right);
    const double size = s.cohesive * s.c * s.c + whole.push.force;
    EXPECT_NEAR(f.push.force + g.push.force, whole.push.force, 1e-6 * size) << k;
    EXPECT_NEAR(f.pull.force + g.pull.force, whole.pull.force, 1e-6 * size) << k;
    EXPECT_NEAR(f.push.area + g.push.area, whole.push.area, 1e-11 * s.c * s.c) << k;
  }
}

// The growth over the whole contact: that of the stress within c of the first state.
TEST(MaugisStress, GrowthIsThatOfTheStress) {
  for (const double modulus : {10.0, 1.0})
    for (const double overlap : {0.1, 0.5}) {
      const MaugisPair pair = pair_of(modulus);
      const MaugisPoint now = maugis_at_overlap(pair, overlap),
                        then = maugis_at_overlap(pair, overlap + 0.005);
      const double far = 2 * now.cohesive_radius;
      const std::array<Vec2, 4> square = {Vec2(-far, -far), Vec2(far, -far), Vec2(far, far),
                                          Vec2(-far, far)};
      const MaugisStress first = make_maugis_stress(pair, now),
                         second = make_maugis_stress(pair, then);
      const StressParts f = integrate_stress(first, second, square);
      const auto between = [&](double low, double high) {
        return 2 * kPi *
               (enclosed_stress(second, high) - enclosed_stress(second, low) -
                enclosed_stress(first, high) + enclosed_stress(first, low));
      };
      EXPECT_NEAR(f.push.growth, between(0, first.reversal),
                  1e-12 * first.hertz * std::pow(first.a, 3));
      EXPECT_NEAR(f.pull.growth, between(first.reversal, first.c),
                  1e-3 * first.hertz * std::pow(first.a, 3));
      EXPECT_GT(f.push.growth, 0);
    }
}

TEST(MaugisStress, IsContinuousAndVanishesBeyondTheRim) {
  for (const double modulus : kModuli) {
    const MaugisStress s = stress_of(modulus, 0.2);
    EXPECT_EQ(stress_at(s, s.c), 0.0);
    EXPECT_EQ(enclosed_stress(s, 2 * s.c), enclosed_stress(s, s.c));
    EXPECT_NEAR(stress_at(s, s.reversal), 0.0, 1e-9 * s.hertz * s.a);
    EXPECT_GT(stress_at(s, 0.99 * s.reversal), 0.0);
    EXPECT_LT(stress_at(s, 1.01 * s.reversal), 0.0);
    for (const double r : {0.3 * s.a, 0.9 * s.a, 0.5 * (s.a + s.c)}) {
      const double h = 1e-5 * s.a;
      const double slope = (enclosed_stress(s, r + h) - enclosed_stress(s, r - h)) / (2 * h);
      EXPECT_NEAR(slope, stress_at(s, r) * r, 1e-5 * s.hertz * s.a * s.a);
    }
  }
}

}  // namespace
}  // namespace acinus::contact
