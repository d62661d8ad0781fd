#pragma once
/// `acinus compare`: how runs of the same scene differ, quantity by quantity.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// A quantity of one run beside that of the reference, the first run.
struct Difference {
  std::string name;  ///< as in --tolerance
  std::string unit;
  double reference = 0, value = 0;
  double difference = 0;            ///< |value - reference| over |reference| unless absolute
  bool absolute = false;            ///< difference is in the unit: distances
  std::optional<double> tolerance;  ///< of difference
  std::string not_measured;  ///< why there is no verdict, which is never a pass; empty: there is
  bool passes() const { return !tolerance || (not_measured.empty() && difference <= *tolerance); }
};

/// What one cell costs to move through the medium, and what cells cost to slide.
struct Drag {
  std::string model;         ///< dcm | cbm
  double medium = 0;         ///< nN s/um, a free cell: 4 pi R^2 gamma
  double cell_friction = 0;  ///< nN s/um^3
};

/// A quantity over time, one line per run.
struct Trace {
  std::string name, unit;
  std::vector<double> time;                ///< s
  std::vector<std::vector<double>> value;  ///< [run][time]
};

struct Comparison {
  std::vector<std::string> runs;  ///< folders, the reference first
  double from = 0, to = 0;        ///< s, of the frames compared
  int frames = 0;
  std::vector<std::vector<Difference>> difference;  ///< [run - 1]
  std::vector<std::string>
      gap;  ///< [run - 1], how it or the reference falls short of what is judged
  std::vector<Trace> trace;
  std::vector<std::vector<Drag>> drag;  ///< [run], of the models it has
  std::vector<std::string> notes;       ///< where the scenes are not the same, and so on
  bool passes() const;
};

/// Names that --tolerance knows, with their meaning.
const std::map<std::string, std::string>& comparable_quantities();

/// Compares the frames that all runs have. A verdict needs all of them completed, with the same
/// end; quantities of single cells need the same cells there.
/// @param tolerance  by name; what is not named has no verdict
/// @param until      s, judge this moment in place of the end; runs must have a frame there
/// @throws Error: a folder without a finished run, fewer than two runs, no frame in common, an
///         unknown name
Comparison compare_runs(const std::vector<std::string>& folders,
                        const std::map<std::string, double>& tolerance,
                        std::optional<double> until = {});

/// Drag of a scene's models, from its canonical JSON.
std::vector<Drag> drag_of(const std::string& resolved_scene, bool has_dcm, bool has_cbm);

/// What to run before comparing.
struct CompareScenes {
  std::string law;          ///< law file for a third run, calibrated spheres; empty = none
  bool equal_drag = false;  ///< spheres get the medium and cell friction of deformable cells
  std::string folder;       ///< run folders dcm, cbm and cbm_calibrated go here
  int threads = 0;
  bool quiet = false;
  std::string command_line;
};

/// Runs a scene with deformable cells, with spheres, and with calibrated spheres; what is done
/// already is not done again.
/// @param folders  out: those to compare
/// @return exit code of a run that was stopped or failed, else 0
int run_models(const Scene& scene, const CompareScenes& options, std::vector<std::string>& folders);

std::string comparison_table(const Comparison& c);
/// JSON to `file` and plots (SVG) beside it, named after it.   @throws Error(kFileError)
void write_comparison(const Comparison& c, const std::string& file);

}  // namespace acinus::runs
