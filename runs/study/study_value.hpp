#pragma once
/// Values of a study with units: parsed, and formatted for reports.

#include <map>
#include <string>

#include "runs/scene/json_text.hpp"
#include "runs/study/study.hpp"

namespace acinus::runs {

/// Unit of a measure by its kind: that of the observable, "s" for times, "1" for p values.
/// @param units  of the observables, by name
std::string unit_of(const StudyMeasure& measure, const std::map<std::string, std::string>& units);

/// Value of the study file as a number in a unit.
/// @throws Error naming the fault
double number_in(const Node& value, const std::string& unit);

/// Value with unit as text: "12.5 um", "3.2 d", "0.31", "never".
std::string show_value(double value, const std::string& unit);

}  // namespace acinus::runs
