#pragma once
/// Experiments of scenes as rows of one table.
///
/// The source NAME_experiment.cpp holds all of an experiment and defines its row; everything else
/// asks the row. docs/developers/add_an_experiment.md says how to add one.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "coupling/life/life.hpp"
#include "coupling/world/world.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/experiments/observable.hpp"
#include "runs/experiments/observed_frame.hpp"
#include "runs/experiments/observed_run.hpp"
#include "runs/scene/experiment_list.hpp"
#include "runs/scene/scene.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {

/// Row of the table: everything particular to one experiment. A null pointer: it has none.
struct ExperimentRow {
  const char* meaning = "";   ///< one line
  SceneRule check = nullptr;  ///< adds the rules that its scenes break to the report
  /// Columns of /observables besides those of every scene, in their order.
  std::vector<Observable> (*columns)() = nullptr;
  /// Adds one number to each of its series, the same series at every frame. Series without a column
  /// are in summary.json only.
  void (*sample)(const ObservedFrame& frame, ObservedRun& observed) = nullptr;
  /// In place of `sample`, for experiments with devices: finds them once, at the first frame. What
  /// it returns refers to devices of the world.
  Sampler (*make_sampler)(const coupling::World& world) = nullptr;
  /// Counts divisions while the daughters are at their birth places.
  void (*count_births)(const Scene& scene, const coupling::World& world,
                       const coupling::LifeReport& report, ObservedRun& observed) = nullptr;
  /// Reason why the run may end; empty: none.
  std::string (*why_over)(const Measures& measures) = nullptr;
  /// Adds figures of the whole run to `measures` of summary.json.
  void (*add_figures)(const Scene& scene, const Measures& measures,
                      nlohmann::ordered_json& figures) = nullptr;
  /// True if it reads of cells only what the snapshot has. Otherwise every process gets the points
  /// of all cells before a frame and before births.
  bool reads_snapshot_only = false;
};

#define ACINUS_ROW(constant, name) extern const ExperimentRow name##_experiment;
ACINUS_EXPERIMENTS(ACINUS_ROW)
#undef ACINUS_ROW

/// Row of an experiment.
const ExperimentRow& experiment_row(Experiment experiment);

/// Adds the numbers of one frame: time_s and cells of any experiment and the series of its own.
void sample_experiment(const ObservedFrame& frame, ObservedRun& observed);

}  // namespace acinus::runs
