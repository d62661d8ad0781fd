#pragma once
/// Values of a study with their units: read from its file, of a measure, shown in reports.

#include <map>
#include <string>

#include "runs/scene/json_text.hpp"
#include "runs/study/study.hpp"

namespace acinus::runs {

/// Unit of what a measure of this kind gives: of the observable, "s" for times, "1" for p values.
std::string unit_of(const StudyMeasure& measure, const std::map<std::string, std::string>& units);

/// A value of the study file as a number in a unit. @throws Error: what is wrong with it
double number_in(const Node& value, const std::string& unit);

/// "12.5 um", "3.2 d", "0.31", "never".
std::string show_value(double value, const std::string& unit);

}  // namespace acinus::runs
