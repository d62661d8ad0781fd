#pragma once
/// Consistency rules between the keys of a study: existing names, values with units.

#include "runs/scene/fault_report.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Adds every violated rule to the report.
void check_study(const StudyPlan& plan, Report& report);

}  // namespace acinus::runs
