#pragma once
/// Messages about a run for its log and summary.

#include <string>
#include <vector>

namespace acinus::runs {

struct Notes {
  std::vector<std::string> said;
  /// Warnings: always on stderr, also with --quiet, and in summary.json.
  std::vector<std::string> warned;
};

}  // namespace acinus::runs
