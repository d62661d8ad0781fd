#pragma once
/// One run of a reference model.

#include <string>
#include <vector>

#include "runs/openvt/openvt.hpp"

namespace acinus::runs {

/// Runs a shipped scene with a model's cells into a folder, or takes what a finished run left there
/// when `options.resume` is set.
/// @param set  PATH=VALUE
/// @return exit code
int run_reference(const std::string& scene, const OpenVtOptions& options,
                  std::vector<std::string> set, const std::string& folder);

}  // namespace acinus::runs
