/// Pairs of young spheres that exert only a share of their contact forces, and contacts as deep as
/// a division makes them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "tests/cbm/spheres.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::cbm {
namespace {

using reference::kEps;

/// Same spheres with strengths from 0 to 1, some of them exactly 0 or 1.
Spheres weakened(Spheres s, std::uint64_t seed) {
  auto random = reference::stream(seed);
  for (std::size_t c = 0; c < s.state.n_cell(); ++c)
    s.state.strength.set(c, Ramp::constant(std::clamp(random.uniform(-0.2, 1.2), 0.0, 1.0)));
  return s;
}

TEST(Strength, ScalesAllThatAPairDoesByTheStrongerCell) {
  Spheres full = random_spheres(5, 80, 40), weak = weakened(full, 50);
  full.find();
  weak.find();
  const std::size_t n = full.state.n_cell();
  std::vector<Vec3> force(n, Vec3::Zero());
  std::vector<double> area(n), overlap(n), size(n);
  std::vector<std::pair<int, int>> touching;
  contact::Contacts listed;
  const std::vector<double> r = full.radius();
  for (const contact::Contact& c : full.sphere()) {
    const std::size_t a = c.a, b = c.b;
    const double share =
        std::max(weak.state.strength[a].at(weak.time), weak.state.strength[b].at(weak.time));
    if (share == 0) continue;
    touching.emplace_back(c.a, c.b);
    const double relative = std::max(0.0, -c.gap / (r[a] + r[b]));
    for (std::size_t k : {a, b}) {
      force[k] += (k == a ? share : -share) * c.force * c.normal;
      size[k] += share * std::abs(c.force);
      area[k] += share * c.touching;
      overlap[k] += share * relative;
    }
    listed.push_back(c);
    listed.back().force *= share;
    listed.back().slope *= share;
    listed.back().touching *= share;
  }
  ASSERT_GT(touching.size(), 100u);
  ASSERT_LT(touching.size(), full.sphere().size());
  EXPECT_EQ(weak.work.touching, touching) << "two strengths of 0 are no contact";
  ASSERT_EQ(weak.sphere().size(), listed.size());
  ASSERT_EQ(weak.links().size(), listed.size());
  Vec3 net = Vec3::Zero();
  double sum = 0;
  // 1e-12: how well the law of eight pairs at once agrees with its scalar twin (jkr_lanes.hpp)
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_LE((weak.force(k) - force[k]).norm(), 1e-11 * size[k]);
    EXPECT_NEAR(weak.work.contact_area[k], area[k], 1e-12 * area[k]);
    EXPECT_NEAR(weak.work.overlap_sum[k], overlap[k], 1e-12 * overlap[k]);
    net += weak.force(k);
    sum += weak.force(k).norm();
  }
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const contact::Contact &found = weak.sphere()[k], &law = listed[k];
    EXPECT_DOUBLE_EQ(found.force, law.force);
    EXPECT_DOUBLE_EQ(found.slope, law.slope);
    EXPECT_NEAR(found.touching, law.touching, 4 * kEps * law.touching);
    // links keep floats
    const solve::PointLink link = weak.links()[k];
    const double stiffness = law.slope, friction = 10 * law.touching;
    EXPECT_NEAR(static_cast<double>(link.stiffness), stiffness, 1e-7 * stiffness + 1e-12);
    EXPECT_NEAR(static_cast<double>(link.friction), friction, 1e-7 * friction);
  }
  std::printf("%zu of %zu contacts left by strengths 0 to 1: net force %.1e of the sum\n",
              listed.size(), full.sphere().size(), net.norm() / sum);
  EXPECT_LT(net.norm(), 64 * kEps * sum);
}

TEST(Strength, OfOneIsNotLookedAtAndChangesNoBit) {
  Spheres s = random_spheres(6, 40, 30);
  EXPECT_TRUE(strengths_at(s.state, 0).empty());
  s.find();
  const auto force = s.system.force;
  const std::vector<double> r = s.radius(), ones(s.state.n_cell(), 1.0);
  contact::ContactList contacts;
  find_contacts({s.state, s.params, s.options, {r, ones}, s.boundary}, s.work, contacts,
                s.system.point_links);
  for (std::size_t k = 0; k < force.size(); ++k) EXPECT_EQ(s.work.force[k], force[k]);
  s.state.strength.set(7, {0, 1, 100, 200});
  EXPECT_EQ(strengths_at(s.state, 100)[7], 0);
  EXPECT_EQ(strengths_at(s.state, 125)[7], 0.25);
  EXPECT_EQ(strengths_at(s.state, 125)[8], 1);
  EXPECT_TRUE(strengths_at(s.state, 200).empty());
}

TEST(Strength, ScalesContactsWithTheBoundary) {
  auto make = [](double strength) {
    NewCell cell = sphere({1, 2, 11});
    cell.strength = Ramp::constant(strength);
    Spheres s({cell});
    contact::Plane floor, mirror;
    floor.material = {.adhesion = 0.01};
    mirror.normal = -Vec3::UnitX();
    mirror.point = {12, 0, 0};
    mirror.material.mirror = true;
    contact::Capsule shell;
    shell.radius = 40;
    shell.center = {1, -26.5, 11};
    s.boundary.planes = {floor, mirror};
    s.boundary.capsules = {shell};
    geometry::Network n;
    n.node = {{-8, -50, 24}, {-8, 50, 24}};
    n.segment = {{0, 1}};
    n.radius = {{4.7, 4.7}};
    contact::set_network(s.boundary.vessels, n);
    s.boundary.vessels.material = {0.01, 0.6, 0.4, false};
    s.find();
    return s;
  };
  const Spheres full = make(1), half = make(0.5), none = make(0);
  ASSERT_EQ(full.obstacle().size(), 4u);
  ASSERT_EQ(half.obstacle().size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const contact::Contact &f = full.obstacle()[k], &h = half.obstacle()[k];
    EXPECT_NE(f.force, 0);
    EXPECT_EQ(h.force, 0.5 * f.force);
    EXPECT_EQ(h.slope, 0.5 * f.slope);
    EXPECT_NEAR(h.touching, 0.5 * f.touching, 4 * kEps * f.touching);
    EXPECT_EQ(half.links()[k].stiffness, 0.5f * full.links()[k].stiffness);
    EXPECT_FLOAT_EQ(half.links()[k].friction, 0.5f * full.links()[k].friction);
  }
  EXPECT_EQ(half.external_force(0), 0.5 * full.external_force(0));
  EXPECT_NEAR(half.work.contact_area[0], 0.5 * full.work.contact_area[0], 1e-10);
  EXPECT_EQ(half.work.overlap_sum[0], 0.5 * full.work.overlap_sum[0]);
  EXPECT_TRUE(none.obstacle().empty());
  EXPECT_TRUE(none.work.touching.empty());
  EXPECT_EQ(none.external_force(0).norm(), 0);
  EXPECT_EQ(none.work.overlap_sum[0], 0);
}

TEST(Strength, OfANeighbourIsEnoughForTheFullContact) {
  Spheres old({sphere({0, 0, 0}), sphere({22, 0, 0}), sphere({0, 22, 0})}), born = old;
  born.state.strength.set(0, Ramp::constant(0));
  born.state.strength.set(2, Ramp::constant(0));
  old.find();
  born.find();
  // Cells 0 and 2 are siblings without strength, 1 is a neighbour of 0 (and far from 2).
  ASSERT_EQ(old.sphere().size(), 2u);
  ASSERT_EQ(born.sphere().size(), 1u);
  EXPECT_EQ(born.force(1), old.force(1));
  EXPECT_EQ(born.force(0), -old.force(1));
  EXPECT_EQ(born.force(2), Vec3::Zero());
  EXPECT_EQ(born.work.overlap_sum[1], old.work.overlap_sum[1]);
  EXPECT_EQ(born.work.overlap_sum[2], 0);
}

TEST(Strength, IsForSistersOnly) {
  Spheres old({sphere({0, 0, 0}), sphere({22, 0, 0}), sphere({0, 22, 0})}), born = old;
  born.state.strength.replace([](const Ramp&) { return Ramp::constant(0); });
  born.mother = {4, 5, 4};
  old.find();
  born.find();
  // Cells 0 and 2 are sisters, 1 is as new but of another mother.
  ASSERT_EQ(born.sphere().size(), 1u);
  EXPECT_EQ(born.force(1), old.force(1));
  EXPECT_EQ(born.force(0), -old.force(1));
  EXPECT_EQ(born.force(2), Vec3::Zero());
  born.mother = {-1, -1, -1};  // initial cells: none is a sister
  born.find();
  EXPECT_EQ(born.sphere().size(), old.sphere().size());
}

TEST(DeepOverlap, ForceStiffnessAndAreaRiseAndStayFinite) {
  for (double adhesion : {0.0, 0.01, 0.05}) {
    double last_force = -1e9, last_stiffness = 0, last_area = 0;
    for (double overlap = 0.5; overlap <= 24; overlap += 0.25) {
      Spheres s({sphere({0, 0, 0}), sphere({0, 24 - overlap, 0})});
      s.params[0].adhesion = adhesion;
      s.find();
      ASSERT_EQ(s.sphere().size(), 1u);
      const contact::Contact& law = s.sphere()[0];  // the scalar law
      ASSERT_TRUE(std::isfinite(law.force) && std::isfinite(law.slope));
      EXPECT_GT(law.force, last_force) << overlap;
      EXPECT_GT(law.slope, last_stiffness) << overlap;
      EXPECT_GT(law.touching, last_area) << overlap;
      EXPECT_GT(4 * kPi * 144, 3 * law.touching) << "two thirds stay free at least";
      last_force = law.force;
      last_stiffness = law.slope;
      last_area = law.touching;
      // eight pairs at once: their normal has round-off of its own
      const double scale = 1e-12 * std::max(std::abs(law.force), law.slope * overlap);
      EXPECT_LT((s.force(0) - law.force * law.normal).norm(), scale);
      EXPECT_EQ(s.force(1), -s.force(0));
      EXPECT_NEAR(s.work.contact_area[0], law.touching, 1e-12 * law.touching);
      EXPECT_NEAR(static_cast<double>(s.links()[0].stiffness), law.slope, 1e-7 * law.slope);
      for (double distance : {18.0, 6.0, 0.5})
        if (std::abs(24 - overlap - distance) < 1e-9)
          std::printf(
              "W %.2f nN/um, centres %4.1f um apart: %6.2f nN (Hertz %6.2f), %5.2f nN/um, a %.2f\n",
              adhesion, distance, law.force,
              4.0 / 3 * 0.45 / (1 - 0.47 * 0.47) / 2 * std::sqrt(6 * std::pow(overlap, 3)),
              law.slope, std::sqrt(law.touching / kPi));
    }
    // Without adhesion F/k = (2/3) overlap: a step of any length takes a pair part of the way.
    EXPECT_LT(last_force, 24 * last_stiffness);
  }
}

TEST(DeepOverlap, CoincidingCentresPartAlongX) {
  Spheres s({sphere({3, -4, 5}), sphere({3, -4, 5}), sphere({100, 0, 0})});
  s.find();
  ASSERT_EQ(s.sphere().size(), 1u);
  EXPECT_EQ(s.sphere()[0].normal, Vec3::UnitX());
  EXPECT_EQ(s.links()[0].normal, (std::array<float, 3>{1, 0, 0}));
  EXPECT_GT(s.force(0).x(), 50);
  EXPECT_EQ(s.force(0).tail<2>().norm(), 0);
  EXPECT_EQ(s.force(1), -s.force(0));
}

}  // namespace
}  // namespace acinus::cbm
