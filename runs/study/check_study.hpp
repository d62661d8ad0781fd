#pragma once
/// Rules between the keys of a study: everything named must exist, every value have its unit.

#include "runs/scene/fault_report.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Adds every broken rule to the report.
void check_study(const StudyPlan& plan, Report& report);

}  // namespace acinus::runs
