#pragma once
/// Numbers of summary.json.

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace acinus::runs {

/// Number of a file; null if it is not finite or absent.
nlohmann::ordered_json finite_number(double value);
nlohmann::ordered_json finite_number(const std::optional<double>& value);

}  // namespace acinus::runs
