#pragma once
/// Two elastic bodies in a circular contact without adhesion [Hertz1882], and the pair type shared
/// with JKR.

#include <limits>

namespace acinus::contact {

inline constexpr double kFlat = std::numeric_limits<double>::infinity();  ///< radius of a plane
inline constexpr double kRigid =
    std::numeric_limits<double>::infinity();  ///< modulus of a rigid body

/// One partner of a contact.
struct SphereBody {
  double radius;   ///< um; kFlat for a plane, negative for a hollow seen from inside
  double young;    ///< kPa; kRigid allowed
  double poisson;  ///< -1 .. 0.5
};

/// All that a contact law needs to know of both partners.
struct SpherePair {
  double radius;          ///< R^ in um: 1/R^ = 1/R_a + 1/R_b
  double modulus;         ///< E^ in kPa: 1/E^ = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b
  double adhesion = 0.0;  ///< W in nN/um (1 mJ/m^2 = 1 nN/um), not negative
};

/// Answer of a contact law; all zero when not touching.
struct SphereForce {
  double force = 0.0;           ///< nN, positive = repulsive
  double contact_radius = 0.0;  ///< a in um
  double stiffness = 0.0;  ///< dF/d(overlap) at fixed modulus, nN/um; may be negative with adhesion
  double force_by_modulus =
      0.0;  ///< dF/dE^ at fixed overlap, um^2: a modulus that depends on compression
  bool touching = false;
};

/// A contact that exerts this share of its force: stiffness and contact area, and with it friction,
/// fall alike. With a share of 0 there is none.
SphereForce weaken(SphereForce law, double share);

/// Reduced radius and modulus of two unlike bodies, either of which may be flat or rigid.
/// @pre 1/R_a + 1/R_b > 0, not both rigid, moduli positive (asserted)
SpherePair reduced_pair(const SphereBody& a, const SphereBody& b, double adhesion);

/// A sphere (R) on the side of a vessel (r), taken as one contact with the vessel's axis segment.
/// The elliptic contact is replaced by a circular one of R^ = sqrt(R' R''), 1/R' = 1/R + 1/r, R'' =
/// R. Against the exact ellipse at equal overlap, R = 12 and r = 4.7 um: force 3.2 % low, area 2.1
/// % high; error falls with r/R. Modulus as in reduced_pair.
/// @param vessel  radius = radius of the vessel where the contact is
SpherePair vessel_pair(const SphereBody& cell, const SphereBody& vessel, double adhesion);

/// F = (4/3) E^ sqrt(R^) delta^(3/2), a = sqrt(R^ delta), dF/d delta = 2 E^ a; pair.adhesion is
/// ignored.
/// @param overlap  delta in um; below zero there is no contact
SphereForce hertz_force(const SpherePair& pair, double overlap);

/// (8/15) E^ sqrt(R^) delta^(5/2) in fJ; its derivative by the overlap is the force.
double hertz_energy(const SpherePair& pair, double overlap);

/// A plane that acts as a mirror: the force of the cell on its own image, which is that of a rigid
/// plane, F = (4/3) E/(1 - nu^2) sqrt(R) (R - h)^(3/2). No adhesion, no tangential part. Stiffness
/// is by the overlap R - h, force_by_modulus by E/(1 - nu^2).
/// @param height  h in um: distance of the centre from the plane
SphereForce mirror_wall_force(const SphereBody& cell, double height);

/// The wall's contribution to the relative overlap of a sphere: 1 - h/R, the value of the
/// image pair.
double mirror_wall_compression(double radius, double height);

}  // namespace acinus::contact
