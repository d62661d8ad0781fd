#pragma once
/// Measured values that an inference compares with, from a CSV file.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runs/study/curves.hpp"

namespace acinus::runs {

/// Measured value of an observable at a time.
struct TargetPoint {
  std::optional<double> time;  ///< s; nothing: the end of the run
  std::string observable;
  double value = 0, sd = 0;  ///< in the unit of the observable; sd > 0
};

/// Reads a table with the columns time_s (or time_min, time_h, time_days; empty fields: the end of
/// the run), observable, value, sd and, if wanted, unit. Other columns and lines that begin with #
/// are ignored.
/// @param units  of the observables, by name
/// @param end    of the runs, s
/// @throws Error with file and line
std::vector<TargetPoint> read_target(const std::string& path,
                                     const std::map<std::string, std::string>& units, double end);

/// Values of a run at the points of the target; empty where one is missing.
std::vector<double> values_at(std::span<const TargetPoint> target,
                              const std::map<std::string, TimeCurve>& curves);

/// Root mean square of differences to the target, each divided by its sd; nan for empty values.
double distance_to(std::span<const TargetPoint> target, std::span<const double> values);

}  // namespace acinus::runs
