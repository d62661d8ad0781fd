#pragma once
/// Laws, studies and comparisons as JSON for the report page.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace acinus::service {

/// Describes a calibrated law, with the force-overlap curves it was fitted to if they stand beside
/// it.
/// @param file  law file, or its folder LAW.calibration
/// @throws Error as calibration::read_law()
nlohmann::ordered_json describe_law(const std::string& file);

/// Describes a study: claims with verdicts, runs, plots, text of its report.
/// @throws Error(kFileError) if the folder has none of them yet
nlohmann::ordered_json describe_study(const std::string& folder);

/// Describes the differences of the second and further runs to the first, or the reason why they
/// cannot be compared.
nlohmann::ordered_json describe_comparison(const std::vector<std::string>& folders);

}  // namespace acinus::service
