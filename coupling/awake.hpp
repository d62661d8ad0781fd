#pragma once
/// Steps of a world in which somebody sleeps. Those awake step in a smaller world of their own,
/// with the sleepers they may touch around them. Sleepers glide at a pace that is set now and then
/// by one long step. (docs/decisions/0015.md)

#include "coupling/step.hpp"
#include "coupling/subworld.hpp"
#include "coupling/workspace.hpp"
#include "coupling/world.hpp"

namespace acinus::coupling {

/// The world that steps. It is made from the large one before every step, so it adds nothing to
/// what a checkpoint must hold; its workspace lives on while the same cells are in it.
struct AwakePart {
  World world;  ///< those that move, then those held
  Workspace work;
  Selected moving, held;          ///< who is in it, of the large world
  std::vector<std::size_t> lane;  ///< [moving.dcm] where they stand here
};

/// Those around some cells that a step of these has to look at: all that may touch them, and what
/// touches the spheres among these, whose stiffness depends on all their contacts.
Selected find_ring(const World& world, const Selected& cells);

/// advance() of a world with sleepers: of those awake. With nobody awake only time passes.
StepResult advance_awake(World& world, Workspace& work, double limit);

/// Sets the pace, kept as their last move, at which sleepers glide for a duration, s, to come: that
/// of one step of everybody as long as it, without motility. (With those awake at a prescribed pace
/// nobody would look at the balance of both together, and whatever pace they have would last.)
/// @return false if there is no such step: then nothing has changed
[[nodiscard]] bool set_sleepers_pace(World& world, Workspace& work, double duration);

}  // namespace acinus::coupling
