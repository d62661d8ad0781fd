#pragma once
/// What cells exert on their neighbours before and after a change of model, and what fades between.

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct PairForce {
  Vec3 force = Vec3::Zero();  ///< nN, on the first of the two
  double virial = 0;          ///< nN um, sum of force . arm of the first
};

/// By the lineages of the two in rising order; of a cell and boundary: (cell, kNoPartner).
using PairForces = std::map<std::pair<std::int64_t, std::int64_t>, PairForce>;

/// Contact forces of these cells with each other and with all others, without what fades already.
/// @param cells  lineages      @pre observe
PairForces compute_pair_forces(const World& world, const Workspace& work,
                               const std::set<std::int64_t>& cells);

/// What has to act beside the new contacts for every pair to exert what it did: of two cells along
/// the line between their centres, so without torque, and with what it adds to the pressure of
/// both. It fades within params.zoom.fade.
/// @param after  of the state as it is now
void add_fading(const World& world, const PairForces& before, const PairForces& after,
                std::vector<FadingForce>& fading);

}  // namespace acinus::coupling
