#pragma once
/// Two deformable cells that adhere and are pulled apart by held forces.

#include <cstdint>

#include "contact/surface.hpp"
#include "dcm/contact/contact_params.hpp"

namespace acinus::bench {

/// What is varied. The rest is the shipped scene adhering_pair.
struct PairCase {
  double adhesion = 0.02;  ///< nN/um, W
  int nodes = 162;
  std::uint64_t seed = 1;  ///< of the orientations of both meshes
  double range = 0;        ///< um, of the cohesive potential; 0: what the scene says
  contact::Quadrature quadrature = contact::Quadrature::kThreePoint;
  double bending = 1;     ///< factor on the stiffness of the hinges
  double stretching = 1;  ///< factor on that of the springs and of the surface's area
  double friction = 0;    ///< nN s/um^3, between the cells
  double hold = 1000;     ///< s, the longest a force is held if the pair does not come to rest
  double step = 2;        ///< s, of the simulation
  dcm::ContactLaw law = dcm::ContactLaw::kCohesive;
  double h0 = 0.02;  ///< um, range of adhesion of Maugis-Dugdale
};

/// A pair under a force that it bears.
struct PairRest {
  double area = 0;      ///< um^2, in contact: within the range of adhesion
  double distance = 0;  ///< um, of the centres
  double pressure = 0;  ///< kPa, of the cytosol, mean of both
  double touching = 0;  ///< um^2, in touch as the run file has it, mean of both
  /// nN/um, tension of the surface: mean over the nodes out of contact, least of those in contact.
  double tension_outside = 0, tension_contact_min = 0;
};

/// The force at which no contact is left.
struct PullOff {
  double kept = 0, lost = 0;  ///< nN, the largest force that was borne and the least that was not
  PairRest start;             ///< without force
  PairRest last;              ///< under the largest force that was borne
  double force() const { return 0.5 * (kept + lost); }
};

/// pi W R^, nN, with R^ = R/2 for two equal cells: theory for vesicles. JKR is 3/2 of it, DMT 2.
/// [VanLiedekerke2020, Eq. (24)]
double vesicle_force(const PairCase& c);

/// The pair comes to rest without force; then opposite forces, spread over the cells, rise in steps
/// of pi W R^ / 5. Each is held until no node moves faster than 2e-4 um/s, or for `hold`. The step
/// in which the contact is lost is halved five times, each time from the state in which the largest
/// force was borne, so that the force is known to pi W R^ / 160.
/// @throws Error if a step of the simulation fails or the cells do not let go
PullOff find_pull_off(const PairCase& c);

/// The pair at rest without force, or after `hold`, and then under a force on it.
struct HeldPair {
  PairRest free, held;
  bool is_still = false, is_borne = false;  ///< free: no node moves faster than 2e-4 um/s
  std::int64_t steps = 0, rejected = 0;
};

/// @param force           nN, of the second hold
/// @param after_cohesive  the pair first comes to rest under the cohesive law: its contact then
///                        shrinks to what the law of the case holds, where it grows otherwise
HeldPair hold_pair(const PairCase& c, double force, bool after_cohesive);

/// Largest attraction of the pair over the distance of its centres while both keep their shape at
/// rest, nN: 2 pi W R^ by Derjaguin.
double find_rigid_pull_off(const PairCase& c);

/// Push of the pair on each other with their centres this far apart, um, while both keep their
/// shape at rest, nN.
double find_rigid_push(const PairCase& c, double distance);

}  // namespace acinus::bench
