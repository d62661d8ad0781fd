#pragma once
/// What became of a study's claims.

#include <string>
#include <vector>

#include "runs/study/study_measures.hpp"

namespace acinus::runs {

enum class ClaimStatus { kHolds, kDoesNotHold, kNotMeasured };

struct Verdict {
  std::string id, claim;
  std::string how;       ///< what was measured, in words
  std::string expected;  ///< "from 0.1 to 0.3", "at most 6 d"
  std::optional<double> expected_low, expected_high;
  bool every_seed = false;
  int least_seeds = 0;  ///< as in StudyExpectation
  Measured measured;
  ClaimStatus status = ClaimStatus::kNotMeasured;
};

/// Checks every expectation. What is not measured never holds.
std::vector<Verdict> check_claims(const StudyPlan& plan, const StudyData& data);

/// "holds", "does not hold", "not measured".
const char* name_of(ClaimStatus status);

/// verdicts.json: [{id, claim, expected, measured, low, high, pass, ...}]; what has no value is
/// null, pass too if nothing was measured.   @throws Error(kFileError)
void write_verdicts(const std::vector<Verdict>& verdicts, const std::string& root);

}  // namespace acinus::runs
