#pragma once
/// Reader of inference files: keys, priors in the coordinates of the sampler.

#include <string>
#include <vector>

#include "runs/infer/inference.hpp"

namespace acinus::runs {

/// Inference with checked priors.
struct InferencePlan {
  Inference inference;
  std::string folder;              ///< base of relative file names
  std::vector<Prior> prior;        ///< one a parameter
  std::vector<std::string> unit;   ///< of the parameters; "1": plain numbers
  std::vector<std::string> label;  ///< short names of the parameters, no two alike
};

/// Reads an inference file.
/// @throws Error listing all faults, one a line with line and column; kFileError for an unreadable
/// file
InferencePlan read_inference(const std::string& path);

/// Reads an inference from a text.
/// @param label   stands for the file name in messages; its stem is the default name
/// @param folder  base of relative file names
InferencePlan parse_inference(const std::string& text, const std::string& label,
                              const std::string& folder);

}  // namespace acinus::runs
