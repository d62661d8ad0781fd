#pragma once
/// Verdicts on the claims of a study.

#include <string>
#include <vector>

#include "runs/study/study_measures.hpp"

namespace acinus::runs {

/// Verdict on a claim.
enum class ClaimStatus { kHolds, kDoesNotHold, kNotMeasured };

/// Claim with its measure, expectation and verdict.
struct Verdict {
  std::string id, claim;
  std::string how;       ///< description of the measure
  std::string expected;  ///< "from 0.1 to 0.3", "at most 6 d"
  std::optional<double> expected_low, expected_high;
  bool every_seed = false;
  int least_seeds = 0;  ///< as in StudyExpectation
  Measured measured;
  ClaimStatus status = ClaimStatus::kNotMeasured;
};

/// Evaluates every expectation. An unmeasured claim never holds.
std::vector<Verdict> check_claims(const StudyPlan& plan, const StudyData& data);

/// Name in reports: "holds", "does not hold", "not measured".
const char* name_of(ClaimStatus status);

/// Writes verdicts.json: [{id, claim, expected, measured, low, high, pass, ...}]; missing values
/// are null, and so is pass of an unmeasured claim.
/// @throws Error(kFileError)
void write_verdicts(const std::vector<Verdict>& verdicts, const std::string& root);

}  // namespace acinus::runs
