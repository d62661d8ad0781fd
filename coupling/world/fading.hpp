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
  Vec3 apart = Vec3::Zero();  ///< um, centre of a from that of b, or from the origin, at first
  double reach = 0;           ///< um, how far they may move from that before none is left
};

/// What is left of a force, from 1 to 0. It fades with time, and with the way of the two relative
/// to each other: what stands in for a contact must not drive cells away that have come apart.
/// @param apart  um, as FadingForce::apart, now
double left_of(const FadingForce& f, double time, const Vec3& apart);

/// Adds what is left of the forces at a time. A pair of which one cell is gone exerts none.
void add_fading_forces(const State& state, double time, CellForces& forces);

/// Leaves as much of the forces as there was before cells were moved by something else than forces.
/// @param before  the same cells, of either model
void keep_fading(const State& before, State& state);

/// Removes those that have faded or lost a cell.
void forget_faded(State& state);

}  // namespace acinus::coupling
