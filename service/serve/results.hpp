#pragma once
/// What a run has measured, kept by what it depends on: an evaluation that was made is not made
/// again.

#include <map>
#include <optional>
#include <string>

#include "runs/study/curves.hpp"

namespace acinus::runs {

struct RunResult {
  std::map<std::string, TimeCurve> curve;   ///< by observable
  std::map<std::string, std::string> unit;  ///< of its values
};

/// The observables of a run folder, also of one that goes on.   @throws Error(kFileError)
RunResult read_run_result(const std::string& run_folder);

/// One line of JSON, {"NAME": {"unit", "time_s", "value"}}.
std::string result_text(const RunResult& result);

/// @throws Error(kFileError)
void keep_result(const std::string& file, const RunResult& result);
/// Nothing if there is none, or it cannot be read: it is made again then.
std::optional<RunResult> find_result(const std::string& file);

}  // namespace acinus::runs
