/// One beam: energy, its derivatives, and what a tube is as one.

#include "coupling/vessels/beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <random>

namespace acinus::coupling {
namespace {

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

const Beam kBeam{10, 3, 40, 30, 0.7};

Mat3 turn_by(const Vec3& turn) {
  const double angle = turn.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3::Identity();
}

/// Beam at rest along x.
BeamEnds straight() {
  return {{Vec3(1, 2, 3), Vec3(1 + kBeam.length, 2, 3)}, {Mat3::Identity(), Mat3::Identity()}};
}

/// Ends moved by (place, place, rotation, rotation).
BeamEnds moved(BeamEnds e, const Vec12& by) {
  for (std::size_t k = 0; k < 2; ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    e.place[k] += by.segment<3>(at);
    e.frame[k] = turn_by(by.segment<3>(6 + at)) * e.frame[k];
  }
  return e;
}

/// Any bent, twisted and stretched beam.
BeamEnds draw_ends(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  Vec12 by;
  for (double& v : by) v = number(random);
  return moved(straight(), by);
}

Vec12 force_on(const BeamEnds& e) {
  const BeamLoad load = compute_load(kBeam, e);
  Vec12 f;
  f << -load.force, load.force, load.moment[0], load.moment[1];
  return f;
}

Mat12 matrix_of(const BeamEnds& e) {
  const BeamStiffness s = compute_stiffness(kBeam, e);
  Mat12 k = Mat12::Zero();
  const auto add_spring = [&k](Eigen::Index at, const Mat3& m) {
    k.block<3, 3>(at, at) += m;
    k.block<3, 3>(at + 3, at + 3) += m;
    k.block<3, 3>(at, at + 3) -= m;
    k.block<3, 3>(at + 3, at) -= m;
  };
  const Mat3 along = s.along * s.along.transpose(), across = Mat3::Identity() - along;
  add_spring(0, s.axial * along + s.lateral * across);
  add_spring(6, s.twist * along + s.bend * across);
  for (std::size_t d = 0; d < 2; ++d) {
    Vec12 g;
    g << -s.place[d], s.place[d], s.turn[d], s.turn[d];
    k += g * g.transpose();
  }
  return k;
}

TEST(Beam, ForcesAreMinusTheGradientOfTheEnergy) {
  std::mt19937 random(1);
  double worst = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const BeamEnds e = draw_ends(random, 0.7);
    const Vec12 force = force_on(e);
    constexpr double kStep = 1e-5;
    for (Eigen::Index k = 0; k < 12; ++k) {
      const Vec12 by = kStep * Vec12::Unit(k);
      const double slope =
          (compute_load(kBeam, moved(e, by)).energy - compute_load(kBeam, moved(e, -by)).energy) /
          (2 * kStep);
      worst = std::max(worst, std::abs(force[k] + slope) / force.norm());
    }
  }
  std::printf("force against difference of the energy: %.2g\n", worst);
  EXPECT_LT(worst, 1e-8);
}

TEST(Beam, NeitherMovesNorTurnsItself) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const BeamEnds e = draw_ends(random, 1);
    const BeamLoad load = compute_load(kBeam, e);
    const Vec3 torque =
        (e.place[1] - e.place[0]).cross(load.force) + load.moment[0] + load.moment[1];
    EXPECT_LT(torque.norm(), 1e-12 * (load.moment[0].norm() + load.moment[1].norm()));
  }
}

TEST(Beam, EnergyDoesNotChangeWhenAllIsTurned) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const BeamEnds e = draw_ends(random, 1);
    const Mat3 turn = turn_by(Vec3(0.3, -2, 1.1));
    BeamEnds turned = e;
    for (std::size_t k = 0; k < 2; ++k) {
      turned.place[k] = turn * e.place[k] + Vec3(5, -7, 2);
      turned.frame[k] = turn * e.frame[k];
    }
    EXPECT_NEAR(compute_load(kBeam, turned).energy, compute_load(kBeam, e).energy, 1e-10);
  }
}

TEST(Beam, StiffnessIsSemiDefiniteAndBlindToRigidMotion) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const BeamEnds e = draw_ends(random, 0.5);
    const Mat12 k = matrix_of(e);
    const Eigen::SelfAdjointEigenSolver<Mat12> solver(k);
    EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-12 * solver.eigenvalues().maxCoeff());
    for (int axis = 0; axis < 3; ++axis) {
      Vec12 shift, turn;
      shift << Vec3::Unit(axis), Vec3::Unit(axis), Vec3::Zero(), Vec3::Zero();
      EXPECT_LT((k * shift).norm(), 1e-12 * k.norm());
      turn << Vec3::Unit(axis).cross(e.place[0]), Vec3::Unit(axis).cross(e.place[1]),
          Vec3::Unit(axis), Vec3::Unit(axis);
      // A beam under tension resists a turn of its ends' places as a string does.
      const BeamStiffness s = compute_stiffness(kBeam, e);
      const Vec3 across = turn.segment<3>(3) - turn.segment<3>(0);
      const Vec12 rest = k * turn;
      EXPECT_LT(rest.norm(), 1e-12 * k.norm() * turn.norm() + 1.5 * s.lateral * across.norm());
    }
  }
}

/// Without push: then nothing is left out of the matrix where the beam is at rest.
TEST(Beam, StiffnessAtRestIsTheSecondDerivative) {
  Beam beam = kBeam;
  beam.push = 0;
  const BeamEnds e = straight();
  Mat12 k = Mat12::Zero();
  constexpr double kStep = 1e-5;
  for (Eigen::Index c = 0; c < 12; ++c) {
    const auto force = [&](double step) {
      const BeamLoad load = compute_load(beam, moved(e, step * Vec12::Unit(c)));
      Vec12 f;
      f << -load.force, load.force, load.moment[0], load.moment[1];
      return f;
    };
    k.col(c) = -(force(kStep) - force(-kStep)) / (2 * kStep);
  }
  EXPECT_LT((k - matrix_of(e)).norm(), 1e-7 * k.norm());
}

/// Lame: a closed tube under a pressure inside.
TEST(Beam, TubeUnderPressureGrowsAsLameSays) {
  const double young = 2, poisson = 0.4, pressure = 0.01;
  for (const double wall : {0.2, 1.0, 3.0}) {
    const Tube tube{5, wall};
    const Beam beam = make_beam(tube, 30, young, poisson, pressure);
    const double strain = beam.push / beam.stretch / beam.length;
    const double inner2 = tube.inner() * tube.inner();
    const double axial = pressure * inner2 / (25 - inner2), hoop = 2 * axial;  // stress outside
    EXPECT_NEAR(strain, (axial - poisson * hoop) / young, 1e-12);
    EXPECT_NEAR(radius_ratio(tube, young, poisson, pressure, strain) - 1,
                (hoop - poisson * axial) / young, 1e-12);
    if (wall > 0.3) continue;
    // The formulas of a thin tube, with its mean radius.
    const double mean = 5 - wall / 2;
    EXPECT_NEAR(strain, pressure * mean / (2 * young * wall) * (1 - 2 * poisson), 0.05 * strain);
  }
}

}  // namespace
}  // namespace acinus::coupling
