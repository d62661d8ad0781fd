#pragma once
/// Claims that are judged for every value of a sweep.

#include <vector>

#include "runs/scene/fault_report.hpp"
#include "runs/study/study.hpp"
#include "runs/study/variants.hpp"

namespace acinus::runs {

/// Adds, behind every expectation with `each`, its copies: one for each value of that sweep, with
/// the variants made from those of the original and the value in id and claim. A label without a
/// sweep, and variants that the sweep did not make, go into the report. @pre check_study
void expand_claims(Study& study, const std::vector<Variant>& variants, Report& report);

}  // namespace acinus::runs
