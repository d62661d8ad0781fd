#pragma once
/// Axisymmetric normal stress of a Maugis-Dugdale contact, Eq. (14) plus Eq. (17), and its exact
/// integral over a polygon of the contact plane.
///
/// With G(r) = integral of p(s) s ds from 0 to r, which has a closed form, the divergence theorem
/// turns integrals over the polygon into integrals along its edges, n the outward normal:
///   force = oint G/r^2 x.n dl,    moment = integral of p x = oint (G - G(c)) n dl.
/// The force is continuous in the corners and in the state of the contact.

#include <span>

#include "contact/maugis.hpp"
#include "core/vec.hpp"

namespace acinus::contact {

using Vec2 = Eigen::Vector2d;

/// Stress around a contact point: repulsive within the radius `reversal`, attractive up to c.
struct MaugisStress {
  double hertz = 0;     ///< kPa/um, 2 E/(pi R)
  double cohesive = 0;  ///< kPa, sigma0
  double a = 0;         ///< um
  double c = 0;         ///< um
  double edge = 0;      ///< um, sqrt(c^2 - a^2)
  double sector = 0;    ///< um^2, c^2 atan(edge/a), a constant of G
  double reversal = 0;  ///< um, radius at which the stress changes its sign; 0: attractive only
};
MaugisStress make_maugis_stress(const MaugisPair& pair, const MaugisPoint& state);

/// Stress at radius r, kPa, positive = repulsive.
double stress_at(const MaugisStress& s, double r);

/// G(r), nN/rad.
double enclosed_stress(const MaugisStress& s, double r);

/// Repulsive or attractive part of the stress over a polygon.
struct StressPart {
  double force = 0;            ///< nN
  double area = 0;             ///< um^2
  Vec2 moment = Vec2::Zero();  ///< nN um, integral of stress times place
  double growth = 0;           ///< nN, force in the second state minus that in the first
};
struct StressParts {
  StressPart push, pull;
};

/// Integral over a polygon with corners in counter-clockwise order, um from the contact point.
/// Relative error of areas 1e-12, of forces and moments below 1e-6, along edges that run through
/// the whole contact; it cancels between polygons that share an edge. Of the growth some percent.
/// @param second  another state, for the growth over the same areas
StressParts integrate_stress(const MaugisStress& first, const MaugisStress& second,
                             std::span<const Vec2> polygon);

}  // namespace acinus::contact
