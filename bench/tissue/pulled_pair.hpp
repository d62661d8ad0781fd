#pragma once
/// Two adhering deformable cells under held pulling forces.

#include <cstdint>

#include "contact/surface.hpp"
#include "dcm/contact/contact_params.hpp"

namespace acinus::bench {

/// Varied parameters of the shipped scene adhering_pair.
struct PairCase {
  double adhesion = 0.02;  ///< adhesion energy W, nN/um
  int nodes = 162;
  std::uint64_t seed = 1;  ///< of both mesh orientations
  double range = 0;        ///< of the cohesive potential, um; 0: as in the scene
  contact::Quadrature quadrature = contact::Quadrature::kThreePoint;
  double bending = 1;     ///< factor on the bending stiffness
  double stretching = 1;  ///< factor on spring stiffness and area modulus
  double friction = 0;    ///< between the cells, nN s/um^3
  double hold = 1000;     ///< longest time a force is held without rest, s
  double step = 2;        ///< time step, s
  dcm::ContactLaw law = dcm::ContactLaw::kCohesive;
  double h0 = 0.02;  ///< range of adhesion of Maugis-Dugdale, um
};

/// State of the pair under a force below pull-off.
struct PairRest {
  double area = 0;      ///< contact area within the range of adhesion, um^2
  double distance = 0;  ///< of the centres, um
  double pressure = 0;  ///< cytosol pressure, mean of both, kPa
  double touching = 0;  ///< touching area as in the run file, mean of both, um^2
  /// Surface tension, nN/um: mean over the nodes outside the contact, minimum over those inside.
  double tension_outside = 0, tension_contact_min = 0;
};

/// Pull-off of a pair, bracketed by two forces.
struct PullOff {
  bool adhered = false;       ///< false: no contact formed from the start of the scene, no values
  double kept = 0, lost = 0;  ///< largest force borne and least force not borne, nN
  PairRest start;             ///< without force
  PairRest last;              ///< under the largest force borne
  double force() const { return 0.5 * (kept + lost); }
};

/// Pull-off force of two equal vesicles, pi W R^ with R^ = R/2, nN. JKR predicts 3/2 of it, DMT 2
/// [VanLiedekerke2020, Eq. (24)].
double vesicle_force(const PairCase& c);

/// Measures the pull-off force. The pair comes to rest without force; then opposite forces,
/// distributed over the cells, rise in increments of pi W R^ / 5. Each is held until no node moves
/// faster than 2e-4 um/s, or for `hold`. After separation the increment is halved five times, each
/// time from the state under the largest force borne, which gives the force to pi W R^ / 160.
/// @throws Error if a step of the simulation fails or the cells do not separate
PullOff measure_pull_off(const PairCase& c);

/// Pair at rest without force, or after `hold`, and then under a force.
struct HeldPair {
  PairRest free, held;
  bool is_still = false,
       is_borne = false;  ///< `free`: no node moves faster than 2e-4 um/s; `held`: force borne
  std::int64_t steps = 0, rejected = 0;
};

/// Holds the pair without force, then under a force.
/// @param force           of the second hold, nN
/// @param after_cohesive  first comes to rest under the cohesive law: the contact then shrinks to
///                        the area of the case's law, where it otherwise grows
HeldPair hold_pair(const PairCase& c, double force, bool after_cohesive);

/// Largest attraction of two rigid cells over the distance of their centres, nN: 2 pi W R^ by
/// Derjaguin.
double compute_rigid_pull_off(const PairCase& c);

/// Repulsion of two rigid cells, nN.
/// @param distance  of the centres, um
double compute_rigid_push(const PairCase& c, double distance);

}  // namespace acinus::bench
