#pragma once
/// Quantitative comparison of runs of one scene (`acinus compare`).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Quantity of one run compared with the reference, the first run.
struct Difference {
  std::string name;  ///< as in --tolerance
  std::string unit;
  double reference = 0, value = 0;
  /// Judged difference: the rms, else the size of the change. Relative to the reference, or
  /// absolute.
  double difference = 0;
  bool absolute = false;            ///< difference is in `unit`, as for distances
  std::optional<double> tolerance;  ///< of the difference
  std::string not_measured;  ///< reason for a missing verdict, which never passes; empty = measured
  bool is_rms = false;       ///< difference is an rms, over time or over cells
  /// Change of the value relative to the reference, with its sign; NaN for absolute differences.
  double change() const;
  /// Rms over time or over cells; NaN for quantities judged by their change.
  double rms() const;
  bool passes() const { return !tolerance || (not_measured.empty() && difference <= *tolerance); }
};

/// Friction coefficients of one model: of a cell with the medium and between cells.
struct Drag {
  CellModel model = CellModel::kDcm;
  double medium = 0;         ///< of a free cell with the medium, 4 pi R^2 gamma, nN s/um
  double cell_friction = 0;  ///< between cells, nN s/um^3; NaN: that of the law of the spheres
};

/// Time series of a quantity in every run.
struct Trace {
  std::string name, unit;
  std::vector<double> time;                ///< s
  std::vector<std::vector<double>> value;  ///< [run][time]
};

/// Result of a comparison of runs.
struct Comparison {
  std::vector<std::string> runs;  ///< run folders, the reference first
  double from = 0, to = 0;        ///< of the compared frames, s
  int frames = 0;
  std::vector<std::vector<Difference>> difference;  ///< [run - 1]
  /// [run - 1], reason why the run or the reference misses the judged time
  std::vector<std::string> gap;
  std::vector<Trace> trace;
  std::vector<std::vector<Drag>> drag;  ///< [run], of its models
  std::vector<std::string> notes;       ///< differences of scenes and frames
  bool passes() const;
};

/// Names of the quantities for --tolerance, with their meaning.
const std::map<std::string, std::string>& comparable_quantities();

/// Compares the frames that all runs have. A verdict needs completed runs with the same end;
/// quantities of single cells need the same cells at that time.
/// @param tolerance  by name; other quantities get no verdict
/// @param until      time to judge in place of the end, s; all runs need a frame there
/// @throws Error for a folder without a finished run, fewer than two runs, no common frame, an
/// unknown name
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::map<std::string, double>& tolerance,
                        std::optional<double> until = {});

/// Friction coefficients of a scene, per model.
/// @param resolved_scene  canonical JSON
std::vector<Drag> drag_of(const std::string& resolved_scene, bool has_dcm, bool has_cbm);

/// Runs of one scene to be made for a comparison.
struct CompareScenes {
  std::string law;          ///< law file for a third run, of calibrated spheres; empty = none
  bool equal_drag = false;  ///< use medium and cell friction of deformable cells for spheres
  std::string folder;       ///< parent of the run folders dcm, cbm and cbm_calibrated
  int threads = 0;
  bool quiet = false;
  std::string command_line;
};

/// Runs a scene with deformable cells, spheres and calibrated spheres; complete runs are not
/// repeated.
/// @param folders  receives the run folders to compare
/// @return exit code: 0, or that of the run that stopped or failed
int run_models(const Scene& scene, const CompareScenes& options, std::vector<std::string>& folders);

/// Comparison as a text table for the terminal.
std::string comparison_table(const Comparison& c);
/// Writes the comparison as JSON to `file`, and its plots (SVG) beside it under the same name.
void write_comparison(const Comparison& c, const std::string& file);

}  // namespace acinus::runs
