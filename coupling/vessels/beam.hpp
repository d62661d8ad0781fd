#pragma once
/// Euler-Bernoulli beam between two nodes with position and rotation, for large rotations and small
/// strains (co-rotational).
///
/// With the unit chord t, its length l, and the axis directions p0, p1 given by the nodes:
///     E = 1/2 k (l - L)^2 - f (l - L) + 3/2 B |t x (p0 + p1)|^2
///         + 1/2 B |t x (p0 - p1)|^2 + 1/2 T a^2
/// k = E A / L, B = E I / L, T = G J / L, f the axial force of an internal pressure, a the twist.
/// For small rotations it is the cubic beam element [Przemieniecki1968], exact for loads at nodes
/// only.

#include <array>

#include "core/vec.hpp"

namespace acinus::coupling {

struct Beam {
  double length = 0;   ///< um, at rest
  double stretch = 0;  ///< nN/um, k
  double bend = 0;     ///< nN um, B
  double twist = 0;    ///< nN um, T
  double push = 0;     ///< nN, f
};

/// Positions and rotations of the ends of a beam.
struct BeamEnds {
  std::array<Vec3, 2> place;
  /// Unit vectors: axis at rest (end 0 to end 1) and two directions across, right-handed, rotated
  /// with the node of each end.
  std::array<Mat3, 2> frame;
};

/// Energy of a beam and its negative derivatives.
struct BeamLoad {
  double energy = 0;                                       ///< fJ
  Vec3 force = Vec3::Zero();                               ///< nN on end 1; the opposite on end 0
  std::array<Vec3, 2> moment{Vec3::Zero(), Vec3::Zero()};  ///< nN um
};
BeamLoad compute_load(const Beam& beam, const BeamEnds& ends);

/// Positive semi-definite part of the second derivative of the energy.
struct BeamStiffness {
  Vec3 along = Vec3::UnitZ();     ///< unit chord
  double axial = 0, lateral = 0;  ///< nN/um, of end 1 relative to end 0
  /// Rows g of the terms g g^T: on the position of end 1 (minus that of end 0), and on both
  /// rotations.
  std::array<Vec3, 2> place{}, turn{};
  double twist = 0, bend = 0;  ///< nN um, of rotation 1 relative to rotation 0: along, across
};
BeamStiffness compute_stiffness(const Beam& beam, const BeamEnds& ends);

/// Tube: outer radius and wall thickness, um; solid if both are equal.
struct Tube {
  double radius = 0, wall = 0;
  double inner() const { return radius > wall ? radius - wall : 0; }
  double area() const;           ///< um^2, of the wall
  double second_moment() const;  ///< um^4
};

/// Elastic constants of a beam from its tube.
/// @param young     kPa
/// @param pressure  kPa, inside, with closed ends; its axial force is p A_inner (1 - 2 nu), since
///                  widening shortens a tube (Lame)
Beam make_beam(const Tube& tube, double length, double young, double poisson, double pressure);

/// Ratio of the outer radius to that at rest, under an internal pressure and an axial strain
/// (Lame).
double radius_ratio(const Tube& tube, double young, double poisson, double pressure, double strain);

}  // namespace acinus::coupling
