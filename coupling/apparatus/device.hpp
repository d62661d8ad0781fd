#pragma once
/// Interface of a device, an object of the scene that acts on cells over time.

#include <cstddef>
#include <span>

#include "cbm/state.hpp"
#include "core/vec.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

/// Cells of both models with forces on whole cells.
struct ForcedCells {
  const dcm::State& dcm;
  const cbm::State& cbm;
  std::span<Vec3> dcm_force;  ///< [dcm lanes] nN, added to
  std::span<Vec3> cbm_force;  ///< [cbm cells] nN, added to
};

/// Deformable cells of a step with the system for loads on their nodes.
struct LoadedCells {
  const dcm::State& state;
  const dcm::LaneData& lanes;
  solve::System& system;  ///< added to
};

/// Plain data of one device and its actions. Actions without an override are empty. Constant after
/// load. Times are s since t = 0, negative during start-up; a step evaluates at its midpoint.
class Device {
 public:
  virtual ~Device() = default;

  /// Next time after `time` with a jump or kink of the action, s; infinite without one. Steps end
  /// there, which keeps the midpoint value of second order.
  virtual double next_change(double time) const = 0;

  /// Changes constants of the cell types for a step.
  /// @param types  [type]
  virtual void set_params(double /*time*/, std::span<dcm::Params> /*types*/) const {}

  /// Adds forces on whole cells. Not called during start-up.
  virtual void add_cell_forces(double /*time*/, const ForcedCells& /*cells*/) const {}

  /// Adds forces on nodes and their stiffness.
  /// @param own  rank-one families counted by count_rank_one
  virtual void add_loads(double /*time*/, const LoadedCells& /*cells*/,
                         std::span<solve::RankOne> /*own*/) const {}

  /// Number of rank-one families (one vector per cell) of its stiffness.
  virtual std::size_t count_rank_one() const { return 0; }

  /// True if the device acts in worlds at rest; false for devices that displace whole cells.
  virtual bool acts_at_rest() const { return true; }
};

}  // namespace acinus::coupling
