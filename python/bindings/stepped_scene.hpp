#pragma once
/// Scene that a caller steps, inspects and changes.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::python {

/// Arrays of positions that the simulation has left behind.
struct Loan {
  HeldRows<double> dcm, cbm;  ///< empty while the simulation still uses them itself
};

class SteppedScene {
 public:
  /// @param scene    a file, or the name of a shipped scene
  /// @param set      PATH=VALUE each
  /// @throws Error   as `acinus run`
  SteppedScene(const std::string& scene, const std::vector<std::string>& set, int threads);

  /// Steps until `end`, s since t = 0, as `acinus run` does: with the same moments at which steps
  /// end, so with the same bits where it is called with the end of the scene or with times of
  /// frames.
  /// @return false: interrupted by a signal
  /// @throws Error(kCannotContinue) if a step cannot be accepted; the state is the last good one
  bool run_until(double end);
  /// One accepted step with its events.   @return as run_until()
  bool step();

  double time() const { return simulation_.time(); }
  bool is_running() const { return simulation_.is_running(); }
  const runs::Scene& scene() const { return scene_; }
  const coupling::World& world() const { return simulation_.world(); }
  const coupling::State& state() const { return world().state; }
  const std::vector<std::string>& type_names() const { return type_names_; }
  std::uint64_t hash() const;
  /// One entry per cell, deformable ones first.
  std::vector<coupling::CellMeasure> measure();

  /// Keeps the positions of both models where they are while the caller holds it: before anything
  /// changes them the simulation goes on with a copy, and what was lent shows what was.
  std::shared_ptr<const Loan> lend_positions();

  /// Puts a cell elsewhere.
  /// @param point  [n_node] um of a deformable cell, [1] of a sphere
  /// @throws Error: no such cell, wrong number of points, a coordinate that is not finite
  void move(std::int64_t lineage, const std::vector<Vec3>& point);
  /// Constant load on a cell, nN.   @throws Error: no such cell, not finite
  void set_pull(std::int64_t lineage, const Vec3& force);

 private:
  bool advance(double end, bool once);
  void take_back();

  runs::Scene scene_;
  int threads_;
  std::vector<std::string> type_names_;
  coupling::Simulation simulation_;
  std::shared_ptr<Loan> loan_;
};

}  // namespace acinus::python
