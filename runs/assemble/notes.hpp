#pragma once
/// What is worth telling about a run beside its figures.

#include <string>
#include <vector>

namespace acinus::runs {

struct Notes {
  std::vector<std::string> said;
  /// What a user must not miss: always on stderr, also with --quiet, and in summary.json.
  std::vector<std::string> warned;
};

}  // namespace acinus::runs
