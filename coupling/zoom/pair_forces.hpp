#pragma once
/// Pair forces before and after a change of model, and the fading differences between them.

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct PairForce {
  Vec3 force = Vec3::Zero();  ///< nN, on the first cell
  double virial = 0;          ///< nN um, sum of force . arm of the first cell
};

/// Pair forces by the two lineages in ascending order; with boundary: (cell, kNoPartner).
using PairForces = std::map<std::pair<std::int64_t, std::int64_t>, PairForce>;

/// Contacts of some cells.
struct CellContacts {
  PairForces pair;                          ///< with each other and all others, without what fades
  std::map<std::int64_t, double> pressure;  ///< kPa, contact pressure of each
};

/// Evaluates the contacts of some cells among their neighbours alone. Every process has the same
/// result.
/// @param cells  lineages      @pre points, contacts and last moves of all cells are complete
CellContacts evaluate_contacts(const World& world, const std::set<std::int64_t>& cells);

/// Fading forces that keep every pair force continuous over a change of model. Between two cells
/// they act along the line of centres, without torque. Their virial restores the pressure of both.
/// They fade within params.zoom.fade.
/// @param after  pair forces of the present state
void add_fading(const World& world, const PairForces& before, const PairForces& after,
                std::vector<FadingForce>& fading);

}  // namespace acinus::coupling
