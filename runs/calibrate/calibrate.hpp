#pragma once
/// `acinus calibrate`: from a scene to the law that corrects its spheres.

#include <string>
#include <vector>

#include "calibration/fit.hpp"
#include "calibration/relaxation.hpp"
#include "runs/calibrate/squeeze_scene.hpp"

namespace acinus::runs {

struct CalibrateOptions {
  ClumpOptions clump;
  calibration::FitOptions fit;
  std::string out;             ///< law file
  bool relaxation = true;      ///< also the time the clump takes to relax
  double relaxation_time = 0;  ///< s, to which the cell-cell friction is fitted; 0 = it is not
  double check_friction =
      0;               ///< nN s/um^3: relaxation time with this cell-cell friction too; 0 = no
  bool fresh = false;  ///< do not use what an earlier run left
  int threads = 0;     ///< 0 = all cores
  bool quiet = false;
  std::string command_line;
};

/// What a calibration found.
struct Calibration {
  std::vector<calibration::FitAttempt> attempts;  ///< the last one is the law
  int inner = 0;                                  ///< cells that are not at the capsule
  calibration::Curve dcm, plain, corrected;       ///< force over overlap, means over inner cells
  double error_plain = 0, error_corrected = 0;    ///< relative, over the fitted range
  double wall_recess = 0;                         ///< cbm::StiffnessLaw::wall_recess of the law
  double capsule_excess = 0;  ///< um, by which the capsule of the corrected spheres is wider
  double contacts_first = 0, contacts_last = 0;  ///< of the central deformable cell
  double overlap_at_rest = 0;                    ///< its d when nothing presses
  std::vector<calibration::Relaxation>
      relaxation;                     ///< Table 1, all friction x 5 (empty: not asked)
  calibration::FrictionFit friction;  ///< 0: not asked for
  double friction_before = 0;         ///< nN s/um^3
  calibration::FrictionFit checked;   ///< CalibrateOptions::check_friction
};

/// Squeezes the clump as deformable cells and as spheres, fits, squeezes the corrected spheres
/// until their capsule is as wide, lets the deformable ones relax. Runs stand in a folder beside
/// the law file and are taken up again where they were left, those of corrected spheres made anew;
/// the law file appears at the end, with curves.json and plots in that folder.
/// @return exit code of a stage that was stopped or failed, else 0
int calibrate(const Scene& scene, const CalibrateOptions& options);

/// The law of every cell type that asks for "auto": found in the cache, or calibrated now and kept
/// there. The cache is acinus/laws in XDG_CACHE_HOME or ~/.cache, its names hashes of the
/// constants. Of several processes that ask for the same law one calibrates, the others wait.
/// @return exit code of a calibration that was stopped or failed, else 0
int resolve_corrections(Scene& scene, int threads, bool quiet);

/// The table that `acinus calibrate` prints.
std::string calibration_table(const Scene& squeeze, const Calibration& found,
                              const std::string& law_file);

/// Writes curves.json, force.svg and relaxation.svg into the folder.   @throws Error(kFileError)
void write_curves(const Calibration& found, const std::string& folder);

}  // namespace acinus::runs
