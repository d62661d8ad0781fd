#pragma once
/// Rules between the keys of a study: everything named must exist, every value have its unit.

#include <map>
#include <string>

#include "runs/scene/report.hpp"
#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Adds every broken rule to the report.
void check_study(const StudyPlan& plan, Report& report);

/// Unit of what a measure of this kind gives: of the observable, "s" for times, "1" for p values.
std::string unit_of(const StudyMeasure& measure, const std::map<std::string, std::string>& units);

/// A value of the study file as a number in a unit. @throws Error: what is wrong with it
double number_in(const Node& value, const std::string& unit);

}  // namespace acinus::runs
