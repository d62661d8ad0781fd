#pragma once
/// Steps of a world with sleeping cells. Awake cells step in a subworld, with neighbouring sleepers
/// as constraints. Sleepers move with a velocity from one long step, renewed on a time grid
/// (decision 15).

#include <cstdint>
#include <memory>

#include "coupling/step/controller.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/subworld/subworld.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Subworld of the awake cells, kept between steps while the set of all cells is the same.
struct AwakePart {
  std::unique_ptr<Subworld> subworld;
  std::uint64_t sized = 0;  ///< Workspace::sized of the whole world at its extraction
};

/// Advances all cells, or those awake, by one accepted step no longer than `limit`. Sleepers keep
/// their velocity to the bit. With no awake cell only the clock advances.
/// @return not accepted if a step of min_step was rejected; State is then the last accepted one
StepResult advance(World& world, Workspace& work, AwakePart& awake, double limit);

/// Sets the velocity of sleepers, kept as their last move, for the next `duration`, s: that of one
/// step of this length without motility, with their neighbours at rest. (With awake neighbours at a
/// prescribed velocity no step would balance both together, and their velocity would persist.)
/// @return not ok if the step failed or the process was asked to stop; nothing has changed then
[[nodiscard]] LoopResult set_sleepers_velocity(World& world, Workspace& work, double duration);

}  // namespace acinus::coupling
