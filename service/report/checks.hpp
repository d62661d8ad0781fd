#pragma once
/// Accuracy figures of a run with their limits.

#include <nlohmann/json_fwd.hpp>

namespace acinus::service {

/// Checks of the figures present in a summary: name, value, unit, limit, at_most (else at least),
/// pass.
/// @param summary  of summary.json
nlohmann::ordered_json list_checks(const nlohmann::ordered_json& summary);

}  // namespace acinus::service
