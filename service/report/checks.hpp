#pragma once
/// What a run says of its own accuracy, beside what it should be.

#include <nlohmann/json_fwd.hpp>

namespace acinus::runs {

/// name, value, unit, limit, at_most (else at least), pass of each check that the summary has.
/// @param summary  of summary.json
nlohmann::ordered_json list_checks(const nlohmann::ordered_json& summary);

}  // namespace acinus::runs
