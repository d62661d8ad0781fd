#pragma once
/// Pair forces that fade: what the contact of two cells lacks, or has too much, of its force since
/// one of them changed its model.

#include <cstdint>
#include <span>
#include <vector>

#include "core/ramp.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

struct State;
struct CellForces;

inline constexpr std::int64_t kNoPartner = -1;

struct FadingForce {
  std::int64_t a = 0, b = kNoPartner;  ///< lineages; b: none if the partner is boundary
  Vec3 force = Vec3::Zero();           ///< nN, on a while the share is 1; b gets the opposite
  double virial = 0;                   ///< nN um, force . arm of a, what it adds to its stress
  Ramp share;                          ///< from 1 to 0
};

/// Adds what is left of the forces at a time. A pair of which one cell is gone exerts none.
void add_fading_forces(const State& state, double time, CellForces& forces);

/// Removes those that have faded or lost a cell.
void forget_faded(State& state);

}  // namespace acinus::coupling
