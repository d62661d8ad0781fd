#pragma once
/// Expansion of claims over the values of a sweep.

#include <vector>

#include "runs/scene/fault_report.hpp"
#include "runs/study/study.hpp"
#include "runs/study/variants.hpp"

namespace acinus::runs {

/// Inserts after every expectation with `each` one copy per value of that sweep. A copy refers to
/// the variants derived with that value, which is appended to id and claim. A label without a sweep
/// and missing variants are added to the report.
/// @pre check_study()
void expand_claims(Study& study, const std::vector<Variant>& variants, Report& report);

}  // namespace acinus::runs
