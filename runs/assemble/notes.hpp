#pragma once
/// Messages about a run for its log and summary.

#include <string>
#include <vector>

namespace acinus::runs {

/// Information and warnings about a run.
struct Notes {
  std::vector<std::string> info;
  /// Warnings: always on stderr, also with --quiet, and in summary.json.
  std::vector<std::string> warnings;
};

}  // namespace acinus::runs
