#pragma once
/// Inference as a whole: its simulations and its posterior (`acinus infer`).

#include <string>

#include "runs/study/active_run.hpp"

namespace acinus::runs {

/// Options of `acinus infer`.
struct InferenceOptions {
  std::string file;
  std::string out;  ///< folder; "" = <name>.infer in the working directory
  int jobs = 0;     ///< concurrent processes; 0 = cores over threads
  ChildRunOptions child;
  bool overwrite = false;  ///< repeat failed runs and runs of another scene or version
  bool quiet = false;
};

/// Infers parameters of a scene and writes the posterior. A killed inference goes on where it was.
/// @return exit code: 0 done, 75 stopped
/// @throws Error for a faulty file, a folder of something else, the disk
int run_inference(InferenceOptions options);

}  // namespace acinus::runs
