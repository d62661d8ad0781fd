#pragma once
/// Calibration of a scene's stiffness law, with its runs in run folders (`acinus calibrate`).

#include <string>

#include "calibration/calibrate.hpp"
#include "runs/calibrate/compression_scene.hpp"

namespace acinus::runs {

/// Options of a calibration.
struct CalibrateOptions {
  ClumpOptions clump;
  calibration::Options calibration;
  std::string out;     ///< law file to write
  bool fresh = false;  ///< ignore the results of an earlier calibration
  int threads = 0;     ///< 0 = all cores
  bool quiet = false;
  std::string command_line;
};

/// Calibrates the stiffness law of a scene. Its runs stand in a folder beside the law file and are
/// resumed there; runs of corrected spheres are always repeated. The law file appears at the end,
/// curves.json and plots in that folder.
/// @return exit code: 0, or that of the run that stopped or failed
int calibrate(const Scene& scene, const CalibrateOptions& options);

}  // namespace acinus::runs
