#include "cbm/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/hertz.hpp"
#include "contact/jkr.hpp"
#include "solve/operator.hpp"
#include "tests/cbm/spheres.hpp"
#include "tests/contact/reference_table.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::cbm {
namespace {

using reference::kEps;

TEST(SpherePairs, BalanceForceAndTorque) {
  Spheres s = random_spheres(1, 60, 40);
  s.find();
  ASSERT_GT(s.links().size(), 100u);
  ASSERT_EQ(s.links().size(), s.sphere().size());
  Vec3 net = Vec3::Zero(), torque = Vec3::Zero();
  double sum = 0, sum_torque = 0;
  for (std::size_t i = 0; i < s.state.n_cell(); ++i) {
    net += s.force(i);
    torque += center_of(s.state, i).cross(s.force(i));
    EXPECT_EQ(s.external_force(i).norm(), 0);
  }
  for (std::size_t l = 0; l < s.links().size(); ++l) {
    const contact::Contact& c = s.sphere()[l];
    for (int k : {c.a, c.b}) {
      sum += std::abs(c.force);
      sum_torque += std::abs(c.force) * center_of(s.state, k).norm();
    }
    EXPECT_EQ(s.links()[l].a, cell_point(0, c.a));
    EXPECT_EQ(s.links()[l].b, cell_point(0, c.b));
  }
  std::printf("%zu sphere pairs: net force %.1e, torque %.1e of the sum\n", s.links().size(),
              net.norm() / sum, torque.norm() / sum_torque);
  EXPECT_LT(net.norm(), 64 * kEps * sum);
  EXPECT_LT(torque.norm(), 64 * kEps * sum_torque);
}

TEST(SpherePairs, ForceIsJkrAlongTheLineOfCentres) {
  Spheres s({sphere({0, 0, 0}, 12, 0.4), sphere({0, 22, 0}, 11, 0.5)});
  s.find();
  ASSERT_EQ(s.links().size(), 1u);
  const auto pair = contact::reduced_pair({12, 0.4, 0.47}, {11, 0.5, 0.47}, 0.01);
  const auto law = contact::jkr_force(pair, 1, false);
  EXPECT_LT((s.force(0) - law.force * Vec3(0, -1, 0)).norm(), 1e-12 * std::abs(law.force));
  EXPECT_EQ(s.force(1), -s.force(0));
  const solve::PointLink link = s.links()[0];
  EXPECT_EQ(solve::address_of(link.a), cell_address(0, 0));
  EXPECT_EQ(solve::address_of(link.b), cell_address(0, 1));
  EXPECT_EQ(link.normal, (std::array<float, 3>{0, -1, 0}));
  // coefficients are kept as floats
  EXPECT_NEAR(static_cast<double>(link.stiffness), std::max(0.0, law.stiffness),
              1e-7 * law.stiffness);
  const double area = kPi * law.contact_radius * law.contact_radius;
  EXPECT_NEAR(static_cast<double>(link.friction), 10 * area, 1e-7 * 10 * area);
  EXPECT_GT(link.stiffness, 0);
}

// Forces are added in double along the exact direction, whatever the matrix keeps of it.
TEST(SpherePairs, ForceDoesNotKnowTheRoundedNormal) {
  Spheres s({sphere({0, 0, 0}), sphere({13, 17, 8})});
  s.find();
  ASSERT_EQ(s.links().size(), 1u);
  const Vec3 u = -Vec3(13, 17, 8).normalized();
  EXPECT_LT((s.force(0) - s.sphere()[0].force * u).norm(), 4 * kEps * s.force(0).norm());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_EQ(s.links()[0].normal[c],
              static_cast<float>(s.sphere()[0].normal[static_cast<int>(c)]));
}

TEST(SpherePairs, StiffnessIsTheSlopeOfTheForce) {
  Spheres s({sphere({0, 0, 0}), sphere({23, 0, 0})});
  s.find();
  const double k = static_cast<double>(s.links()[0].stiffness), h = 1e-4;
  s.move(1, {23 - h, 0, 0});
  s.find();
  const double more = -s.force(0).x();
  s.move(1, {23 + h, 0, 0});
  s.find();
  EXPECT_NEAR((more + s.force(0).x()) / (2 * h), k, 1e-6 * k);
}

TEST(SpherePairs, AdhesionHasHysteresis) {
  const auto pair = contact::reduced_pair({12, 0.45, 0.47}, {12, 0.45, 0.47}, 0.01);
  const double least = contact::jkr_special(pair).fold.overlap;  // below zero
  Spheres s({sphere({0, 0, 0}), sphere({30, 0, 0})});
  int approach = 0, retreat = 0;
  for (double distance = 26; distance > 22; distance -= 0.01) {
    s.move(1, {distance, 0, 0});
    s.find();
    const double overlap = 24 - distance;
    EXPECT_EQ(s.links().size(), overlap >= 0 ? 1u : 0u) << overlap;
    approach += overlap < 0 ? 1 : 0;
    s.accept();
  }
  double deepest = 0;
  for (double distance = 22; distance < 26; distance += 0.01) {
    s.move(1, {distance, 0, 0});
    s.find();
    const double overlap = 24 - distance;
    EXPECT_EQ(s.links().size(), overlap >= least ? 1u : 0u) << overlap;
    if (s.links().size() == 1 && overlap < 0) {
      ++retreat;
      deepest = std::min(deepest, s.sphere()[0].force);
      EXPECT_LT(s.sphere()[0].force, 0);
    }
    s.accept();
  }
  std::printf(
      "JKR: contact from overlap 0, until %.4f um; pull-off %.4f nN of -(3/2) pi W R = %.4f\n",
      least, deepest, contact::jkr_special(pair).pull_off.force);
  EXPECT_GT(approach, 100);
  EXPECT_GT(retreat, 10);
  EXPECT_NEAR(deepest, contact::jkr_special(pair).pull_off.force, 1e-3 * std::abs(deepest));
  EXPECT_TRUE(s.state.touching.empty());
}

// A rejected step must leave no trace: only accepting it changes who touches.
TEST(SpherePairs, SearchDoesNotChangeTheState) {
  Spheres s({sphere({0, 0, 0}), sphere({23, 0, 0})});
  s.find();
  EXPECT_TRUE(s.state.touching.empty());
  EXPECT_EQ(s.work.touching.size(), 1u);
  s.move(1, {24.01, 0, 0});
  s.find();
  EXPECT_EQ(s.links().size(), 0u);
}

TEST(SpherePairs, ListsFindWhatTryingEveryPairFinds) {
  auto random = reference::stream(2);
  std::size_t total = 0;
  for (std::uint64_t seed = 10; seed < 14; ++seed) {
    Spheres s = random_spheres(seed, 80, 50);
    s.find();
    s.accept();
    for (int round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < s.state.n_cell(); ++i)
        s.move(i, center_of(s.state, i) + (round == 3 ? 0.5 : 0.037) * random.unit_vector());
      const int builds = s.work.list_builds;
      s.find();
      EXPECT_EQ(s.work.list_builds, builds + (round == 3 ? 1 : 0));
      const auto r = s.radius();
      std::vector<std::pair<int, int>> expected;
      double worst = 0;
      for (int i = 0; i < 80; ++i)
        for (int j = i + 1; j < 80; ++j) {
          const std::size_t a = i, b = j;
          const Params &p = s.params[s.state.type[a]], &q = s.params[s.state.type[b]];
          const auto pair = contact::reduced_pair({r[a], s.state.young[a], p.poisson},
                                                  {r[b], s.state.young[b], q.poisson},
                                                  std::sqrt(p.adhesion * q.adhesion));
          const bool before = std::ranges::count(s.state.touching, std::pair(i, j)) > 0;
          const auto law = contact::jkr_force(
              pair, r[a] + r[b] - (center_of(s.state, a) - center_of(s.state, b)).norm(), before);
          if (!law.touching) continue;
          expected.emplace_back(i, j);
          for (const contact::Contact& c : s.sphere())
            if (c.a == i && c.b == j) worst = std::max(worst, std::abs(c.force - law.force));
        }
      EXPECT_EQ(s.work.touching, expected);
      EXPECT_EQ(s.sphere().size(), expected.size());
      EXPECT_LT(worst, 1e-12);
      total += expected.size();
      s.accept();
    }
  }
  std::printf("sphere lists: %zu contacts as by trying every pair\n", total);
}

// Adhesion far out of range of the overlap: the lists must reach to where the softest pair lets go.
TEST(SpherePairs, StretchedAdhesiveContactsStayInTheLists) {
  Spheres s({sphere({0, 0, 0}, 12, 0.3), sphere({23.9, 0, 0}, 12, 0.3)});
  s.params[0].adhesion = 0.1;
  s.find();
  s.accept();
  const auto pair = contact::reduced_pair({12, 0.3, 0.47}, {12, 0.3, 0.47}, 0.1);
  const double last = 24 - contact::jkr_special(pair).fold.overlap;
  for (double distance = 23.9; distance < last - 0.01; distance += 0.05) {
    s.move(1, {distance, 0, 0});
    s.find();
    ASSERT_EQ(s.links().size(), 1u) << distance;
    s.accept();
  }
}

TEST(Vessels, StretchedAdhesiveContactWithASoftVesselStaysInTheLists) {
  Spheres s({sphere({0, 0, 16.6}, 12, 5)});
  geometry::Network n;
  n.node = {{-50, 0, 0}, {50, 0, 0}};
  n.segment = {{0, 1}};
  n.radius = {{4.7, 4.7}};
  contact::set_network(s.boundary.vessels, n);
  s.boundary.vessels.material = {0.1, 0.1, 0.4, false};
  s.options.skin = 0.01;
  s.find();
  s.accept();
  const auto pair = contact::vessel_pair({12, 5, 0.47}, {4.7, 0.1, 0.4}, 0.1);
  const double last = 16.7 - contact::jkr_special(pair).fold.overlap;
  for (double z = 16.6; z < last - 0.01; z += 0.05) {
    s.move(0, {0, 0, z});
    s.find();
    ASSERT_EQ(s.links().size(), 1u) << z << " of " << last;
    s.accept();
  }
}

TEST(Vessels, OneContactForAnySpacingOfTheChain) {
  const auto law =
      contact::jkr_force(contact::vessel_pair({12, 0.45, 0.47}, {4.7, 0.6, 0.4}, 0), 0.5, false);
  for (int pieces : {1, 2, 7, 20, 43, 85}) {
    Spheres s({sphere({1.3, 0, 16.2})});
    geometry::Network n;
    for (int k = 0; k <= pieces; ++k) n.node.emplace_back(-50 + 100.0 * k / pieces, 0, 0);
    for (int k = 0; k < pieces; ++k) {
      n.segment.push_back({k, k + 1});
      n.radius.push_back({4.7, 4.7});
    }
    contact::set_network(s.boundary.vessels, n);
    s.boundary.vessels.material = {0, 0.6, 0.4, false};
    s.find();
    ASSERT_EQ(s.links().size(), 1u) << pieces;
    EXPECT_EQ(s.links()[0].b, solve::kNowhere);
    EXPECT_LT((s.external_force(0) - law.force * Vec3::UnitZ()).norm(), 1e-12) << pieces;
    EXPECT_EQ(s.force(0).norm(), 0);
    const double friction = 0.5 * kPi * law.contact_radius * law.contact_radius;
    EXPECT_NEAR(static_cast<double>(s.links()[0].friction), friction, 1e-7 * friction);  // a float
    EXPECT_EQ(relative_overlap(s.work, 0, {}), 0) << "vessels are kept out of the overlap";
  }
}

// A cell that slides along an adhesive vessel keeps its contact where one segment ends.
TEST(Vessels, StretchedContactSurvivesAJoint) {
  Spheres s({sphere({-3, 0, 16.6})});
  geometry::Network n;
  n.node = {{-50, 0, 0}, {0, 0, 0}, {50, 0, 0}};
  n.segment = {{0, 1}, {1, 2}};
  n.radius = {{4.7, 4.7}, {4.7, 4.7}};
  contact::set_network(s.boundary.vessels, n);
  s.boundary.vessels.material = {0.05, 0.6, 0.4, false};
  s.find();
  s.accept();
  for (double x = -3; x < 3; x += 0.1) {
    s.move(0, {x, 0, 16.75});  // pulled: the overlap is below zero
    s.find();
    ASSERT_EQ(s.links().size(), 1u) << x;
    s.accept();
  }
}

TEST(Walls, MirrorActsAsTheImageCell) {
  Spheres wall({sphere({0, 0, 11})}), image({sphere({0, 0, 11}), sphere({0, 0, -11})});
  contact::Plane p;
  p.material.mirror = true;
  wall.boundary.planes = {p};
  image.params[0].adhesion = 0;
  wall.find();
  image.find();
  ASSERT_EQ(wall.links().size(), 1u);
  ASSERT_EQ(image.links().size(), 1u);
  EXPECT_LT((wall.external_force(0) - image.force(0)).norm(), 1e-12);
  EXPECT_EQ(wall.links()[0].friction, 0);  // no tangential friction
  EXPECT_NEAR(relative_overlap(wall.work, 0, {}), (1 - 11.0 / 12) / kNeighbours, 1e-14);
  EXPECT_NEAR(relative_overlap(image.work, 0, {}), (1 - 11.0 / 12) / kNeighbours, 1e-14);
  EXPECT_NEAR(wall.work.contact_area[0], image.work.contact_area[0], 1e-10);
  const auto hertz = 4.0 / 3 * 0.45 / (1 - 0.47 * 0.47) * std::sqrt(12.0);
  EXPECT_NEAR(wall.external_force(0).z(), hertz, 1e-12);
  wall.move(0, {0, 0, 12.01});
  wall.find();
  EXPECT_EQ(wall.links().size(), 0u) << "a mirror never pulls";
}

TEST(Walls, MeetCrowdedSpheresNearerAndStiffer) {
  // d = (1 - 9/12) / 12 = 0.0208, so E~ = 0.05 + 0.5.
  const StiffnessLaw law{{}, {{0.01, 0}, {0.02, 0.5}, {0.3, 0.5}}, 0.3, 0.2};
  const double modulus = 0.55, late = 0.2 * std::pow(0.5 / 0.55, 2);
  for (const bool capsule : {false, true}) {
    Spheres s({sphere({0, 0, 9}, 12, 0.05)});
    s.params[0].poisson = 0.47;
    s.params[0].correction = law;
    contact::Plane floor;
    floor.material = {};
    contact::Capsule shell;
    shell.center = {0, 0, 50};
    shell.radius = 50;
    if (capsule) {
      s.boundary.capsules = {shell};
    } else {
      s.boundary.planes = {floor};
    }
    s.find();
    ASSERT_EQ(s.obstacle().size(), 1u);
    ASSERT_NEAR(s.work.modulus[0].value, modulus, 1e-12);
    const auto expected = contact::hertz_force(
        contact::reduced_pair({12, 2 * modulus - 0.05, 0.47},
                              {capsule ? -50 : contact::kFlat, contact::kRigid, 0}, 0),
        12 * (1 - late) - 9);
    EXPECT_NEAR(s.obstacle()[0].force, expected.force, 1e-12 * expected.force);
    EXPECT_NEAR(s.obstacle()[0].gap, -3, 1e-12) << "where the wall is, for the pressure";
  }
  Spheres mirror({sphere({0, 0, 9}, 12, 0.05)});
  mirror.params[0].poisson = 0.47;
  mirror.params[0].correction = law;
  contact::Plane p;
  p.material.mirror = true;
  mirror.boundary.planes = {p};
  mirror.find();
  EXPECT_NEAR(mirror.obstacle()[0].force, contact::mirror_wall_force({12, modulus, 0.47}, 9).force,
              1e-12)
      << "an equal cell stands behind a mirror, no wall";
}

TEST(Walls, CoupleByTheModulusOfTheFace) {
  const StiffnessLaw law{{}, {{0.01, 0}, {0.03, 1}}, 0.3, 0.2};
  Spheres s({sphere({0, 0, 9}, 12, 0.05)});
  s.params[0].poisson = 0.47;
  s.params[0].correction = law;
  s.boundary.planes = {contact::Plane{}};
  s.boundary.planes[0].material = {};
  s.find();
  ASSERT_EQ(s.obstacle().size(), 1u);
  const double plane_strain = 1 - 0.47 * 0.47;
  const WallFace face = wall_face(law, 0.05, s.work.modulus[0].value);
  const contact::Material& wall = s.boundary.planes[0].material;
  const double by_modulus =
      contact::jkr_force(contact::reduced_pair({12, face.modulus, 0.47},
                                               {contact::kFlat, wall.young, wall.poisson}, 0),
                         3 - 12 * face.recess, false)
          .force_by_modulus;
  EXPECT_NEAR(s.work.coupling[0], 1 / kNeighbours * 2 * by_modulus / plane_strain * 50 / 12, 1e-12);
}

TEST(Walls, MovingPlaneAndShrinkingCapsule) {
  Spheres s({sphere({0, 0, 12.5})});
  contact::Plane p;
  p.speed = 0.1;
  p.travel = 3;
  p.material = {.adhesion = 0.01};
  contact::Capsule shell;
  shell.radius = 60;
  shell.center = {0, 0, -35};
  shell.speed = 0.1;
  shell.min_radius = 30;
  s.boundary.planes = {p};
  s.boundary.capsules = {shell};
  s.find();
  EXPECT_EQ(s.links().size(), 0u);
  s.time = 10;
  s.find();
  ASSERT_EQ(s.links().size(), 2u);
  const auto floor = contact::jkr_force(
      contact::reduced_pair({12, 0.45, 0.47}, {contact::kFlat, contact::kRigid, 0}, 0.01), 0.5,
      false);
  const auto cap = contact::jkr_force(
      contact::reduced_pair({12, 0.45, 0.47}, {-59, contact::kRigid, 0}, 0), 0.5, false);
  const auto force = [&](std::size_t k) {
    return Vec3(s.obstacle()[k].force * s.obstacle()[k].normal);
  };
  EXPECT_LT((force(0) - floor.force * Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((force(1) + cap.force * Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((s.external_force(0) - (floor.force - cap.force) * Vec3::UnitZ()).norm(), 1e-12);
  for (std::size_t k : {0, 1}) {
    EXPECT_EQ(s.links()[k].a, cell_point(0, 0));
    EXPECT_EQ(s.links()[k].b, solve::kNowhere);
    EXPECT_EQ(s.links()[k].normal, (std::array<float, 3>{0, 0, k == 0 ? 1.0f : -1.0f}));
  }
}

TEST(RelativeOverlap, IsThatOfAllContactsTogetherAndNeverFallsAsOneComesNearer) {
  Spheres s({sphere({0, 0, 0}), sphere({23, 0, 0}), sphere({-26, 0, 0})});
  const double own = 1 - 23.0 / 24;
  double last = own / kNeighbours, steepest = 0;
  for (double gap = 26; gap > 22; gap -= 1e-3) {
    s.move(2, {-gap, 0, 0});
    s.find();
    s.accept();
    const double d = relative_overlap(s.work, 0, {});
    EXPECT_GE(d, last);
    steepest = std::max(steepest, d - last);
    last = d;
  }
  EXPECT_LT(steepest, 1.001e-3 / 24 / kNeighbours);  // no jump where they meet
  EXPECT_NEAR(last, (own + (1 - 22.0 / 24)) / kNeighbours, 1e-5);
}

TEST(RelativeOverlap, CountsWallsOfAnyKindAsTheImageBehindThem) {
  for (const bool mirror : {false, true}) {
    Spheres s({sphere({0, 0, 11})});
    contact::Plane floor;
    floor.material.mirror = mirror;
    s.boundary.planes = {floor};
    s.find();
    EXPECT_NEAR(relative_overlap(s.work, 0, {}), (1 - 11.0 / 12) / kNeighbours, 1e-14) << mirror;
  }
  Spheres s({sphere({0, 0, 11})});
  contact::Capsule shell;
  shell.radius = 22;
  s.boundary.capsules = {shell};
  s.find();
  EXPECT_NEAR(relative_overlap(s.work, 0, {}), (1 - 11.0 / 12) / kNeighbours, 1e-14);
}

TEST(Params, YoungFromBulkMatchesReference) {
  const auto rows = test::read_reference("elastic_relation.csv");
  double worst = 0;
  for (const auto& row : rows)
    worst = std::max(worst, test::relative(young_from_bulk(test::number(row, 0) * test::kPascal,
                                                           test::number(row, 1)),
                                           test::number(row, 2) * test::kPascal));
  std::printf("elastic_relation: %zu rows, worst %.1e\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_NEAR(young_from_bulk(2.5, 0.47), 0.45, 1e-15);
}

TEST(State, RadiiFollowTheVolume) {
  Spheres s({sphere({1, 2, 3}, 12), sphere({4, 5, 6}, 9)});
  s.state.volume[0] = {4.0 / 3 * kPi * 1728, 8.0 / 3 * kPi * 1728, 0, 86400};
  EXPECT_NEAR(radii_at(s.state, 0)[0], 12, 1e-13);
  EXPECT_NEAR(radii_at(s.state, 86400)[0], 15.119, 1e-3);
  EXPECT_NEAR(radii_at(s.state, 86400)[1], 9, 1e-13);
  EXPECT_EQ(center_of(s.state, 1), Vec3(4, 5, 6));
  EXPECT_EQ(blocks_of(random_spheres(3, 17, 10).state).size(), 3u);
}

}  // namespace
}  // namespace acinus::cbm
