#pragma once
/// What is no run, as the page's script reads it.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace acinus::runs {

/// A calibrated law, with the curves of force against overlap that it was fitted to where they
/// stand beside it.
/// @param file  a law, or the folder LAW.calibration
/// @throws Error as calibration::read_law()
nlohmann::ordered_json describe_law(const std::string& file);

/// A study: its claims with their verdicts, its runs, its plots.
/// @throws Error(kFileError) if the folder has none of them yet
nlohmann::ordered_json describe_study(const std::string& folder);

/// How the second and further runs differ from the first, or why that cannot be said.
nlohmann::ordered_json describe_comparison(const std::vector<std::string>& folders);

}  // namespace acinus::runs
