#pragma once
/// One elastic beam between two nodes that have a place and a rotation: Euler and Bernoulli's,
/// large rotations and small strains (co-rotational).
///
/// With the unit chord t, its length l, and the directions p0, p1 that the nodes give the beam's
/// axis:
///     E = 1/2 k (l - L)^2 - f (l - L) + 3/2 B |t x (p0 + p1)|^2 + 1/2 B |t x (p0 - p1)|^2 + 1/2 T
///     a^2
/// k = E A / L, B = E I / L, T = G J / L, f the push of a pressure inside, a the twist. For small
/// rotations it is the cubic beam element [Przemieniecki1968], which is exact where
/// loads act at nodes only.

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

/// Where the ends of a beam are, and how their nodes turned.
struct BeamEnds {
  std::array<Vec3, 2> place;
  /// Unit: the axis at rest (from end 0 to end 1) and two directions across it, right-handed, as
  /// the node at each end has turned them.
  std::array<Mat3, 2> frame;
};

/// Minus the derivatives of the energy.
struct BeamLoad {
  double energy = 0;                                       ///< fJ
  Vec3 force = Vec3::Zero();                               ///< nN on end 1; the opposite on end 0
  std::array<Vec3, 2> moment{Vec3::Zero(), Vec3::Zero()};  ///< nN um
};
BeamLoad compute_load(const Beam& beam, const BeamEnds& ends);

/// The second derivative without what would make it indefinite.
struct BeamStiffness {
  Vec3 along = Vec3::UnitZ();     ///< unit chord
  double axial = 0, lateral = 0;  ///< nN/um, of the second place against the first
  /// Rows g of g g^T: on the second place (minus that on the first), and on both rotations.
  std::array<Vec3, 2> place{}, turn{};
  double twist = 0, bend = 0;  ///< nN um, of the second rotation against the first: along, across
};
BeamStiffness compute_stiffness(const Beam& beam, const BeamEnds& ends);

/// A tube: outer radius and thickness of its wall, um; as thick as the radius it is solid.
struct Tube {
  double radius = 0, wall = 0;
  double inner() const { return radius > wall ? radius - wall : 0; }
  double area() const;           ///< um^2, of the wall
  double second_moment() const;  ///< um^4
};

/// @param young     kPa
/// @param pressure  kPa, inside, with closed ends: as if it were on the axis alone it pushes with
///                  p A_inner (1 - 2 nu), since what widens a tube shortens it (Lame)
Beam make_beam(const Tube& tube, double length, double young, double poisson, double pressure);

/// Outer radius over that at rest under a pressure inside and an axial strain (Lame).
double radius_ratio(const Tube& tube, double young, double poisson, double pressure, double strain);

}  // namespace acinus::coupling
