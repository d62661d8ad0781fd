#pragma once
/// Cache of evaluation results by everything they depend on.

#include <map>
#include <optional>
#include <string>

#include "runs/study/curves.hpp"

namespace acinus::service {

/// Observables of a run over time.
struct RunResult {
  std::map<std::string, runs::TimeCurve> curve;  ///< by observable
  std::map<std::string, std::string> unit;       ///< of the values, by observable
};

/// Observables of a run folder, also of a run in progress.
/// @throws Error(kFileError)
RunResult read_run_result(const std::string& run_folder);

/// JSON text on one line, {"NAME": {"unit", "time_s", "value"}}.
std::string result_text(const RunResult& result);

/// Writes a result to the cache.
/// @throws Error(kFileError)
void keep_result(const std::string& file, const RunResult& result);
/// Reads a result; empty if it is missing or unreadable, and then evaluated again.
std::optional<RunResult> find_result(const std::string& file);

}  // namespace acinus::service
