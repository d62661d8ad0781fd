/// Moduli that grow with compression: the law, balance, and steps of any length that do not blow
/// up.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/cbm/spheres.hpp"

namespace acinus::cbm {
namespace {

constexpr double kA1 = 4000;  // kPa, the paper's value

StiffnessLaw quartic() { return {{{kA1, 4}}, {}, 0.2}; }

TEST(StiffnessLaw, IsThePolynomialWithinItsRange) {
  for (double d : {0.0, 0.03, 0.1, 0.2}) {
    const Modulus m = corrected_modulus(quartic(), 0.45, d);
    EXPECT_NEAR(m.value, 0.45 + kA1 * std::pow(d, 4), 1e-14 * m.value);
    EXPECT_NEAR(m.slope, 4 * kA1 * std::pow(d, 3), 1e-14 * m.slope);
  }
  const StiffnessLaw two{{{100, 2}, {kA1, 4}}, {}, 0.2};
  EXPECT_NEAR(corrected_modulus(two, 0.45, 0.1).value, 0.45 + 1 + 0.4, 1e-14);
  EXPECT_EQ(corrected_modulus({}, 0.45, 0.3).value, 0.45);
  EXPECT_EQ(corrected_modulus({}, 0.45, 0.3).slope, 0);
}

TEST(StiffnessLaw, FollowsATable) {
  const StiffnessLaw law{{}, {{0.07, 0}, {0.08, 1}, {0.2, 4}}, 0.2};
  ASSERT_TRUE(law.corrects());
  EXPECT_EQ(corrected_modulus(law, 0.1, 0.03).value, 0.1);
  EXPECT_EQ(corrected_modulus(law, 0.1, 0.03).slope, 0);
  EXPECT_NEAR(corrected_modulus(law, 0.1, 0.075).value, 0.6, 1e-13);
  EXPECT_NEAR(corrected_modulus(law, 0.1, 0.075).slope, 100, 1e-10);
  EXPECT_NEAR(corrected_modulus(law, 0.1, 0.2).value, 4.1, 1e-13);
  EXPECT_NEAR(corrected_modulus(law, 0.1, 0.24).value, 5.1, 1e-13) << "on along the last stretch";
  EXPECT_NEAR(corrected_modulus(law, 0.1, 5).value, 6.6, 1e-13);
  EXPECT_EQ(corrected_modulus(law, 0.1, 5).slope, 0);
}

TEST(StiffnessLaw, GivesCrowdedSpheresAFaceAtWalls) {
  StiffnessLaw law = quartic();
  law.wall_recess = 0.3;
  const WallFace cap = wall_face(law, 0.45, 0.45), half = wall_face(law, 0.45, 0.9),
                 face = wall_face(law, 0.45, 450);
  EXPECT_EQ(cap.recess, 0);
  EXPECT_EQ(cap.modulus, 0.45);
  EXPECT_EQ(cap.slope, 1);
  EXPECT_NEAR(half.recess, 0.3 / 4, 1e-15);
  EXPECT_NEAR(half.modulus, 1.35, 1e-15);
  EXPECT_NEAR(face.recess, 0.3, 1e-3);
  EXPECT_NEAR(face.modulus, 2 * 450, 0.5);
  EXPECT_EQ(face.slope, 2);
  EXPECT_EQ(wall_face({}, 0.45, 0.45).recess, 0);
}

TEST(StiffnessLaw, GoesOnAlongItsTangentAndEnds) {
  const double end = kLawCap * 0.2, h = 1e-7;
  for (double d : {0.2, 0.24, end - 1e-3}) {
    const Modulus less = corrected_modulus(quartic(), 0.45, d - h),
                  more = corrected_modulus(quartic(), 0.45, d + h);
    EXPECT_NEAR((more.value - less.value) / (2 * h), corrected_modulus(quartic(), 0.45, 0.2).slope,
                1e-3);
  }
  EXPECT_EQ(corrected_modulus(quartic(), 0.45, end).value,
            corrected_modulus(quartic(), 0.45, 5).value);
  EXPECT_EQ(corrected_modulus(quartic(), 0.45, 5).slope, 0);
}

TEST(StiffnessLaw, StiffensTowardOneNeighbourBeyondItsRange) {
  const StiffnessLaw law = quartic();
  const Modulus crowd = corrected_modulus(law, 0.45, 0.05);
  for (double overlap : {0.0, 0.1, 0.2, 0.24})
    EXPECT_EQ(modulus_toward(law, 0.45, crowd, overlap).value, crowd.value) << overlap;
  for (double overlap : {0.26, 0.35, 0.5})
    EXPECT_EQ(modulus_toward(law, 0.45, crowd, overlap).value,
              corrected_modulus(law, 0.45, overlap - 0.2).value);
  const Modulus dense = corrected_modulus(law, 0.45, 0.2);
  EXPECT_EQ(modulus_toward(law, 0.45, dense, 0.39).value, dense.value) << "the crowd decides";
  EXPECT_EQ(modulus_toward({}, 0.45, {0.45, 0}, 0.6).value, 0.45) << "no law";
}

TEST(StiffnessLaw, LeavesSingleOverlapsOutWhereAsked) {
  StiffnessLaw law = quartic();
  law.single_overlaps = false;
  EXPECT_EQ(modulus_toward(law, 0.45, {0.45, 0}, 0.5).value, 0.45);
}

/// Row of three, 4 um and 2 um in each other, and the middle one 3 um in a mirror.
Spheres row(const StiffnessLaw& law) {
  Spheres s({{0, 0, Vec3(-20, 0, 0), 12, 0.45, Vec3::Zero()},
             {1, 0, Vec3(0, 0, 0), 12, 0.45, Vec3::Zero()},
             {2, 0, Vec3(22, 0, 0), 12, 0.45, Vec3::Zero()}});
  contact::Plane mirror;
  mirror.point = Vec3(0, 0, -9);
  mirror.material.mirror = true;
  s.boundary.planes.push_back(mirror);
  s.params[0].correction = law;
  s.find();
  return s;
}

TEST(Correction, OfThePaperTakesTheMeanOfTheContacts) {
  const Spheres s = row(paper_law()), sum = row(quartic());
  // 4/24, 2/24 and 3/12; all three touch the mirror.
  const double ends[] = {(4.0 / 24 + 0.25) / 2, (2.0 / 24 + 0.25) / 2}, middle = 0.5 / 3;
  EXPECT_NEAR(relative_overlap(s.work, 1, paper_law()), middle, 1e-15);
  EXPECT_NEAR(relative_overlap(s.work, 0, paper_law()), ends[0], 1e-15);
  EXPECT_NEAR(relative_overlap(s.work, 2, paper_law()), ends[1], 1e-15);
  EXPECT_NEAR(s.work.modulus[1].value, 0.45 + 4000 * std::pow(middle, 4), 1e-13);
  EXPECT_NEAR(relative_overlap(sum.work, 1, quartic()), 0.5 / 12, 1e-15);
  EXPECT_TRUE(sum.work.overlap_count.empty()) << "what no law asks for is not counted";
  EXPECT_LT((s.force(0) + s.force(1) + s.force(2)).norm(), 1e-12 * s.force(0).norm());
}

TEST(Correction, OfThePaperIsThatOfASphereThatNothingTouches) {
  Spheres s({{0, 0, Vec3(0, 0, 0), 12, 0.45, Vec3::Zero()}});
  s.params[0].correction = paper_law();
  s.find();
  EXPECT_EQ(relative_overlap(s.work, 0, paper_law()), 0);
  EXPECT_EQ(s.work.modulus[0].value, 0.45);
}

/// Two spheres alone with this relative overlap.
Spheres deep_pair(double overlap) {
  const double apart = 24 * (1 - overlap);
  Spheres s({{0, 0, Vec3(0, 0, 0), 12, 0.45, Vec3::Zero()},
             {1, 0, Vec3(apart, 0, 0), 12, 0.45, Vec3::Zero()}});
  s.params[0].correction = quartic();
  s.find();
  return s;
}

TEST(Correction, ADeepPairIsHeldApartAndItsStiffnessIsTheSlopeOfItsForce) {
  // Where E~(d) is that of d = 0.5 / 12 the pair would stand 29 nN, as without a law.
  EXPECT_GT(deep_pair(0.5).force(1).x(), 1000);
  const double h = 1e-6;
  for (double overlap : {0.3, 0.4, 0.49, 0.55}) {
    const double slope =
        (deep_pair(overlap + h).force(1).x() - deep_pair(overlap - h).force(1).x()) / (48 * h);
    const Spheres s = deep_pair(overlap);
    ASSERT_EQ(s.links().size(), 1u);
    // Links are kept in floats; what d adds for all contacts together is a bound on top.
    EXPECT_NEAR(s.links()[0].stiffness / slope, 1, 1e-5) << overlap;
    EXPECT_NEAR(s.sphere()[0].force, s.force(1).x(), 1e-12 * s.force(1).x());
    EXPECT_EQ(s.force(0), Vec3(-s.force(1)));
  }
}

/// 27 places of a body-centred cubic lattice next to one of them, nearest neighbours with this
/// relative overlap, shaken a little, in a shell that presses on the outermost as much.
Spheres make_clump(double overlap, std::uint64_t seed) {
  constexpr double kRadius = 12;
  std::vector<Vec3> place;
  const double edge = 2 * kRadius * (1 - overlap) / (0.5 * std::sqrt(3.0));
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k)
        for (double half : {0.0, 0.5})
          place.push_back(edge * (Vec3(i, j, k) + Vec3::Constant(half)));
  std::ranges::stable_sort(place, {}, [](const Vec3& x) { return x.squaredNorm(); });
  auto random = reference::stream(seed);
  std::vector<NewCell> cells;
  for (std::size_t k = 0; k < 27; ++k)
    cells.push_back(sphere(place[k] + 0.02 * kRadius * random.unit_vector(), kRadius));
  Spheres s(cells);
  s.params[0].poisson = 0.47;
  s.params[0].correction = quartic();
  contact::Capsule shell;
  shell.radius = place[26].norm() + kRadius * (1 - overlap);
  s.boundary.capsules = {shell};
  s.find();
  s.accept();
  return s;
}

Eigen::VectorXd forces(Spheres& s) {
  std::ranges::fill(s.system.force, 0.0);
  std::ranges::fill(s.system.external_force, 0.0);
  s.find();
  Eigen::VectorXd f(3 * static_cast<Eigen::Index>(s.state.n_cell()));
  for (std::size_t c = 0; c < s.state.n_cell(); ++c)
    f.segment<3>(3 * static_cast<Eigen::Index>(c)) = s.force(c) + s.external_force(c);
  return f;
}

/// -dF/dx by differences.
Eigen::MatrixXd jacobian(Spheres& s) {
  const auto n = 3 * static_cast<Eigen::Index>(s.state.n_cell());
  Eigen::MatrixXd j(n, n);
  const double h = 1e-5;  // um
  for (std::size_t c = 0; c < s.state.n_cell(); ++c)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = center_of(s.state, c);
      s.move(c, x + h * Vec3::Unit(k));
      const Eigen::VectorXd more = forces(s);
      s.move(c, x - h * Vec3::Unit(k));
      const Eigen::VectorXd less = forces(s);
      s.move(c, x);
      j.col(3 * static_cast<Eigen::Index>(c) + k) = (less - more) / (2 * h);
    }
  return j;
}

/// Friction/h + stiffness as the solver has it.
Eigen::MatrixXd matrix(Spheres& s, double h) {
  const auto n = 3 * static_cast<Eigen::Index>(s.state.n_cell());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  forces(s);
  const std::vector<double> r = s.radius();
  for (std::size_t c = 0; c < s.state.n_cell(); ++c)
    a.diagonal().segment<3>(3 * static_cast<Eigen::Index>(c)).array() +=
        medium_friction(s.params[0], r[c], s.work.contact_area[c]) / h;
  for (const solve::PointLink& l : s.system.point_links) {
    const Vec3 normal(l.normal[0], l.normal[1], l.normal[2]);
    const Mat3 m = static_cast<double>(l.stiffness) * normal * normal.transpose() +
                   static_cast<double>(l.friction) / h * Mat3::Identity();
    const auto at = 3 * static_cast<Eigen::Index>(l.a), to = 3 * static_cast<Eigen::Index>(l.b);
    a.block<3, 3>(at, at) += m;
    if (l.b == solve::kNowhere) continue;
    a.block<3, 3>(to, to) += m;
    a.block<3, 3>(at, to) -= m;
    a.block<3, 3>(to, at) -= m;
  }
  return a;
}

/// Steps until nothing moves: only about rest does a step that neither grows nor shrinks what
/// disturbs it say anything about the method. Compressed spheres out of balance do run away.
void settle(Spheres& s) {
  for (int k = 0; k < 4000; ++k) {
    const Eigen::MatrixXd a = matrix(s, 600);
    const Eigen::VectorXd move = a.ldlt().solve(forces(s));
    for (std::size_t c = 0; c < s.state.n_cell(); ++c)
      s.move(c, center_of(s.state, c) + move.segment<3>(3 * static_cast<Eigen::Index>(c)));
    s.accept();
    if (move.cwiseAbs().maxCoeff() < 1e-7) return;
  }
}

struct Spectrum {
  double least, most;  ///< real parts of the eigenvalues of a step
  double radius;
};
Spectrum spectrum(const Eigen::MatrixXd& a, const Eigen::MatrixXd& j) {
  const Eigen::MatrixXd step =
      Eigen::MatrixXd::Identity(a.rows(), a.cols()) - a.partialPivLu().solve(j);
  const Eigen::VectorXcd v = Eigen::EigenSolver<Eigen::MatrixXd>(step, false).eigenvalues();
  return {v.real().minCoeff(), v.real().maxCoeff(), v.cwiseAbs().maxCoeff()};
}

TEST(Correction, ForcesOfPairsBalance) {
  Spheres s = make_clump(0.12, 5);
  s.boundary = {};
  const Eigen::VectorXd f = forces(s);
  Vec3 net = Vec3::Zero(), torque = Vec3::Zero();
  double sum = 0;
  for (std::size_t c = 0; c < s.state.n_cell(); ++c) {
    const Vec3 force = f.segment<3>(3 * static_cast<Eigen::Index>(c));
    net += force;
    torque += center_of(s.state, c).cross(force);
    sum += force.norm();
  }
  EXPECT_GT(sum, 1);
  EXPECT_LT(net.norm(), 1e-13 * sum);
  EXPECT_LT(torque.norm(), 1e-11 * sum);
}

TEST(Correction, StiffensTheCentralCell) {
  Spheres soft = make_clump(0.2, 5), stiff = make_clump(0.2, 5);
  soft.params[0].correction = {};
  soft.find();
  stiff.find();
  const double d = relative_overlap(stiff.work, 0, {});
  double sum = 0;
  for (const contact::Contact& c : stiff.sphere())
    if (c.a == 0 || c.b == 0) sum += std::max(0.0, -c.gap / 24);
  EXPECT_NEAR(d, sum / 12, 1e-13);
  EXPECT_GT(d, 0.1);
  EXPECT_NEAR(stiff.work.modulus[0].value, 0.45 + kA1 * std::pow(d, 4), 1e-12);
  EXPECT_EQ(soft.work.modulus[0].value, 0.45);
  EXPECT_GT(stiff.sphere()[0].force, 3 * soft.sphere()[0].force);
}

/// Matrix of the step with the moduli held fixed.
Eigen::MatrixXd frozen_matrix(Spheres& s, double h) {
  Eigen::MatrixXd fixed = matrix(s, h);
  const std::vector<double> coupling = s.work.coupling;
  for (const solve::PointLink& l : s.system.point_links) {
    const std::size_t a = l.a, b = l.b;
    if (l.friction == 0 && l.stiffness == 0) continue;
    const Vec3 n(l.normal[0], l.normal[1], l.normal[2]);
    const bool wall = l.b == solve::kNowhere;
    const Mat3 m = (coupling[a] + (wall ? 0 : coupling[b])) * n * n.transpose();
    const auto at = 3 * static_cast<Eigen::Index>(a), to = 3 * static_cast<Eigen::Index>(b);
    fixed.block<3, 3>(at, at) -= m;
    if (wall) continue;
    fixed.block<3, 3>(to, to) -= m;
    fixed.block<3, 3>(at, to) += m;
    fixed.block<3, 3>(to, at) += m;
  }
  return fixed;
}

/// Measures of 27 spheres in a shell that shrinks.
struct Compression {
  double lowest = 1, highest = 0;    ///< d of the central one
  double overshoot = 0, growth = 0;  ///< of steps: -1 and 1 would be neutral
  double frozen_overshoot = 0;       ///< with moduli held fixed
};
Compression compress_clump(const StiffnessLaw& law, double young, double smallest) {
  Compression found;
  Spheres s = make_clump(0.1, 5);
  s.params[0].correction = law;
  s.params[0].young = young;
  s.state.young.replace([&](double) { return young; });
  for (double radius : {42.0, 40.0, 37.5, 36.0, 34.5, 33.0, 0.5 * (33 + smallest), smallest}) {
    s.boundary.capsules[0].radius = radius;
    settle(s);
    forces(s);
    const double d = relative_overlap(s.work, 0, {});
    found.lowest = std::min(found.lowest, d);
    found.highest = std::max(found.highest, d);
    const Eigen::MatrixXd j = jacobian(s);
    for (double h : {60.0, 300.0, 1800.0}) {
      const Spectrum with = spectrum(matrix(s, h), j), without = spectrum(frozen_matrix(s, h), j);
      std::printf("d %.3f, %4.0f s: eigenvalues %.3f .. %.6f, with E~ held fixed %.3f .. %.6f\n", d,
                  h, with.least, with.most, without.least, without.most);
      found.overshoot = std::min(found.overshoot, with.least);
      found.growth = std::max(found.growth, with.most);
      found.frozen_overshoot = std::min(found.frozen_overshoot, without.least);
    }
  }
  return found;
}

TEST(Correction, StepsOfAnyLengthAreStable) {
  const Compression found = compress_clump(quartic(), 0.45, 32.2);
  EXPECT_LT(found.lowest, 0.06);
  EXPECT_GT(found.highest, 0.19);
  EXPECT_GE(found.overshoot, -1);
  EXPECT_LE(found.growth, 1 + 1e-5);  // turning as a whole is neutral; differences know it to 1e-6
  EXPECT_LT(found.frozen_overshoot, -1) << "this test must be able to fail";
}

TEST(Correction, StepsDoNotOvershootWithATable) {
  // As calibrated: next to nothing until cells fill the available volume, then steeper than any
  // power. Such a clump can buckle, so growth says nothing about the step.
  const StiffnessLaw table{{},
                           {{0.068, 0},
                            {0.0707, 0.08},
                            {0.0722, 0.3},
                            {0.0753, 0.6},
                            {0.0845, 1.2},
                            {0.0994, 2.2},
                            {0.12, 3.5},
                            {0.165, 5}},
                           0.165};
  for (const double wall : {0.0, 0.3}) {
    StiffnessLaw law = table;
    law.wall_recess = wall;
    const Compression found = compress_clump(law, 0.042, wall > 0 ? 30.5 : 31);
    EXPECT_GT(found.highest, 0.16);
    EXPECT_GE(found.overshoot, 0);
    EXPECT_LT(found.frozen_overshoot, -1) << "this test must be able to fail";
  }
}

}  // namespace
}  // namespace acinus::cbm
