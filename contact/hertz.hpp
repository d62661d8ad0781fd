#pragma once
/// Two elastic bodies in a circular contact without adhesion [Hertz1882], and the pair type shared
/// with JKR.

#include <limits>

namespace acinus::contact {

inline constexpr double kFlat = std::numeric_limits<double>::infinity();  ///< radius of a plane
inline constexpr double kRigid =
    std::numeric_limits<double>::infinity();  ///< modulus of a rigid body

/// One side of a contact between two spheres.
struct SphereBody {
  double radius;   ///< um; kFlat for a plane, negative for a hollow seen from inside
  double young;    ///< kPa; kRigid allowed
  double poisson;  ///< -1 .. 0.5
};

/// Reduced constants of a contact between two spheres.
struct SpherePair {
  double radius;          ///< R^ in um: 1/R^ = 1/R_a + 1/R_b
  double modulus;         ///< E^ in kPa: 1/E^ = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b
  double adhesion = 0.0;  ///< W in nN/um (1 mJ/m^2 = 1 nN/um), not negative
};

/// Result of a contact law; all zero without contact.
struct SphereForce {
  double force = 0.0;           ///< nN, positive = repulsive
  double contact_radius = 0.0;  ///< a in um
  double stiffness = 0.0;  ///< dF/d(overlap) at fixed modulus, nN/um; may be negative with adhesion
  double force_by_modulus =
      0.0;  ///< dF/dE^ at fixed overlap, um^2: a modulus that depends on compression
  bool touching = false;
};

/// Contact scaled by a share: force, stiffness and contact area, and with the area friction. A
/// share of 0 is no contact.
SphereForce weaken(SphereForce law, double share);

/// Reduced radius and modulus of two unlike bodies, either of which may be flat or rigid.
/// @pre 1/R_a + 1/R_b > 0, not both rigid, moduli positive (asserted)
SpherePair reduced_pair(const SphereBody& a, const SphereBody& b, double adhesion);

/// Reduced pair of a sphere (R) at the side of a vessel (r), for one contact with the vessel's axis
/// segment. The elliptic contact is replaced by a circular one of R^ = sqrt(R' R''), 1/R' = 1/R +
/// 1/r, R'' = R. Against the exact ellipse at equal overlap, R = 12 and r = 4.7 um: force 3.2 %
/// low, area 2.1 % high; error falls with r/R. Modulus as in reduced_pair.
/// @param vessel  its radius is that of the vessel at the contact
SpherePair vessel_pair(const SphereBody& cell, const SphereBody& vessel, double adhesion);

/// Hertz contact: F = (4/3) E^ sqrt(R^) delta^(3/2), a = sqrt(R^ delta), dF/d delta = 2 E^ a;
/// pair.adhesion is ignored.
/// @param overlap  delta in um; below zero there is no contact
SphereForce hertz_force(const SpherePair& pair, double overlap);

/// Elastic energy of a Hertz contact, (8/15) E^ sqrt(R^) delta^(5/2) in fJ; its derivative by the
/// overlap is the force.
double hertz_energy(const SpherePair& pair, double overlap);

/// Force of a sphere on a mirror plane: that on its own image, which equals that of a rigid plane,
/// F = (4/3) E/(1 - nu^2) sqrt(R) (R - h)^(3/2). No adhesion, no tangential part. Stiffness is by
/// the overlap R - h, force_by_modulus by E/(1 - nu^2).
/// @param height  h in um: distance of the centre from the plane
SphereForce mirror_wall_force(const SphereBody& cell, double height);

/// Contribution of a mirror plane to the relative overlap of a sphere: 1 - h/R, that of the image
/// pair.
double mirror_wall_compression(double radius, double height);

}  // namespace acinus::contact
