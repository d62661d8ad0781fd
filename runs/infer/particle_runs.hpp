#pragma once
/// Simulations of an inference: proposals as runs of a study, compared with the target.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runs/infer/read_inference.hpp"
#include "runs/infer/target.hpp"
#include "runs/study/scheduler.hpp"

namespace acinus::runs {

/// Simulation of a proposal, done or failed.
struct SimulatedRun {
  Proposal proposal;
  std::string name;           ///< of the run: "p2_00017/seed_481516"
  std::vector<double> value;  ///< at the points of the target; empty: failed
  double distance = 0;        ///< nan: failed
  std::string cause;          ///< of a failure
};

/// Runs of an inference in one folder. The run of a proposal has a seed of its own; all that the
/// folder holds is found again by a later process.
class ParticleRuns {
 public:
  /// Checks scene, keys and target.
  /// @throws Error listing what is wrong
  ParticleRuns(const InferencePlan& plan, ScheduleOptions options);

  /// Simulates proposals, several at once; see Simulate. Noise of the size of sd is added to the
  /// values before they are compared, if the method is abc: the target has it, too.
  /// @throws Error(kCannotContinue) if a run was killed, since its result would depend on chance
  std::optional<std::vector<double>> simulate(std::span<const Proposal> proposals);

  const std::vector<TargetPoint>& target() const { return target_; }
  const std::map<std::string, std::string>& units() const { return units_; }
  /// Simulations so far, by population and index.
  const std::map<std::pair<int, std::int64_t>, SimulatedRun>& runs() const { return runs_; }

 private:
  StudyPlan study_of(std::span<const Proposal> proposals) const;

  const InferencePlan& plan_;
  ScheduleOptions options_;
  std::map<std::string, std::string> units_;
  std::vector<TargetPoint> target_;
  std::map<std::pair<int, std::int64_t>, SimulatedRun> runs_;
};

/// Value of a parameter as a scene has it: "0.3 nN".
std::string value_text(double value, const std::string& unit);

}  // namespace acinus::runs
