#pragma once
/// Run of one reference model.

#include <string>
#include <vector>

#include "runs/openvt/openvt.hpp"

namespace acinus::runs {

/// Runs a shipped scene with the model of the options in a folder. With options.resume a complete
/// run is not repeated.
/// @param set  changes of the scene, PATH=VALUE
/// @return exit code
int run_reference(const std::string& scene, const OpenVtOptions& options,
                  std::vector<std::string> set, const std::string& folder);

}  // namespace acinus::runs
