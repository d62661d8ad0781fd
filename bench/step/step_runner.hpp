#pragma once
/// A scene brought to a state from which the same steps are timed again and again.

#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/parallel/timing.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

/// One case: a scene, how many steps warm it up, and how many are measured from the saved state.
struct StepCase {
  std::string name, scene;
  int warm_up = 20, steps = 60, repeats = 5;
  bool grows = false;
  bool once = false;           ///< measured once: a copy of a million cells would show
  bool always_coarse = false;  ///< every solve with its coarse space
};

struct StepSample {
  double cpu = 0, wall = 0;  ///< s
  Traffic traffic;           ///< of this process
  std::vector<StageTime> stages;
  std::int64_t cg = 0, solves = 0;
  std::uint64_t hash = 0;  ///< of the state afterwards
};

class StepRunner {
 public:
  /// Error: a step of the warm-up fails.
  explicit StepRunner(const StepCase& c, const Ranks& ranks = Ranks::serial());
  StepRunner(const StepRunner&) = delete;  // the operator points at the system
  StepRunner& operator=(const StepRunner&) = delete;

  /// From the saved state.
  StepSample measure();
  StepSample measure_median();  ///< by CPU time
  int cells() const;
  double contacts_per_cell() const;
  double bytes_per_cell() const;
  const coupling::Workspace& work() const { return work_; }

 private:
  void advance(int steps);
  StepCase case_;
  coupling::World world_;
  coupling::Workspace work_;
  coupling::State saved_;  ///< empty if measured once
  coupling::Clock first_;  ///< when measuring begins
  std::uint64_t bytes_ = 0;
};

}  // namespace acinus::bench
