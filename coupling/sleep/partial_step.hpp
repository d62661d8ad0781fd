#pragma once
/// Steps of a world in which cells sleep. The cells awake step in a subworld of their own, with the
/// sleepers they may touch constrained around them. Sleepers go on with a velocity that one long
/// step of theirs sets now and then. (docs/decisions/0015.md)

#include <cstdint>
#include <memory>

#include "coupling/step/controller.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/subworld/subworld.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Those around some cells that a step of these has to look at: all that may touch them, and what
/// touches the spheres among these, whose stiffness depends on all their contacts.
CellSet find_ring(const World& world, const CellSet& cells);

/// The cells awake as a world of their own, kept between steps while the set of all cells stays.
struct AwakePart {
  std::unique_ptr<Subworld> subworld;
  std::uint64_t sized = 0;  ///< Workspace::sized of the whole world when it was made
};

/// Advances by one accepted step no longer than `limit`: of all cells, or of those awake. Sleepers
/// keep to their velocity to the bit. With no cell awake only time passes.
/// Not accepted: a step of min_step was still rejected; State is the last good one.
StepResult advance(World& world, Workspace& work, AwakePart& awake, double limit);

/// Sets the velocity, kept as their last move, of sleepers for a duration, s, to come: that of one
/// step as long as it of sleepers whose neighbours stand still, without motility. (With those awake
/// at a prescribed velocity no step would look at the balance of both together, and whatever
/// velocity they have would last.)
/// @return not ok if there is no such step, or the process is asked to stop: then nothing has
/// changed
[[nodiscard]] LoopResult set_sleepers_velocity(World& world, Workspace& work, double duration);

}  // namespace acinus::coupling
