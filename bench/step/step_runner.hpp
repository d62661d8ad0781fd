#pragma once
/// Repeated timing of the same steps from one saved state.

#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/parallel/timing.hpp"
#include "coupling/measure/memory_use.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

/// Case of a measurement: scene, number of warm-up steps, number of measured steps.
struct StepCase {
  std::string name, scene;
  int warm_up = 20, steps = 60, repeats = 5;
  bool grows = false;
  bool once = false;           ///< measure once; a copy of a million cells would distort the memory
  bool always_coarse = false;  ///< use the coarse space in every solve
};

/// Cost of the measured steps, and the state they lead to.
struct StepSample {
  double cpu = 0, wall = 0;  ///< s
  Traffic traffic;           ///< of this process
  std::vector<StageTime> stages;
  std::int64_t cg = 0, solves = 0;
  std::uint64_t hash = 0;  ///< of the final state
};

/// Scene after its warm-up, whose next steps can be timed repeatedly.
class StepRunner {
 public:
  /// Runs the warm-up.
  /// @throws Error if one of its steps fails
  explicit StepRunner(const StepCase& c, const Ranks& ranks = Ranks::serial());
  StepRunner(const StepRunner&) = delete;  // the operator points at the system
  StepRunner& operator=(const StepRunner&) = delete;

  /// Restores the saved state and times the steps.
  StepSample measure();
  StepSample measure_median();  ///< median by CPU time
  int cells() const;
  double contacts_per_cell() const;
  double bytes_per_cell() const;
  const coupling::Workspace& work() const { return work_; }
  std::vector<coupling::MemoryUse> measure_memory() {
    return coupling::measure_memory(world_.state, work_);
  }

 private:
  void advance(int steps);
  StepCase case_;
  coupling::World world_;
  coupling::Workspace work_;
  coupling::State saved_;  ///< empty if measured once
  coupling::Clock first_;  ///< at the start of the measurement
  std::uint64_t bytes_ = 0;
};

}  // namespace acinus::bench
