#pragma once
/// `acinus calibrate`: from a scene to the law that corrects its spheres, with the runs it takes in
/// run folders.

#include <string>

#include "calibration/calibrate.hpp"
#include "runs/calibrate/compression_scene.hpp"

namespace acinus::runs {

struct CalibrateOptions {
  ClumpOptions clump;
  calibration::Options calibration;
  std::string out;     ///< law file
  bool fresh = false;  ///< do not use what an earlier run left
  int threads = 0;     ///< 0 = all cores
  bool quiet = false;
  std::string command_line;
};

/// Runs stand in a folder beside the law file and are taken up again where they were left, those of
/// corrected spheres made anew; the law file appears at the end, with curves.json and plots in that
/// folder.
/// @return exit code of a run that was stopped or failed, else 0
int calibrate(const Scene& scene, const CalibrateOptions& options);

}  // namespace acinus::runs
