#pragma once
/// The measures of a study's claims, taken from what its runs recorded.

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "runs/study/study_data.hpp"

namespace acinus::runs {

/// A number, or why there is none.
struct Measured {
  std::optional<double> value;      ///< mean over seeds, the median if some never; infinite = never
  std::optional<double> low, high;  ///< over seeds; empty for what has no value per seed
  std::string unit;
  std::string note;  ///< why it is not measured, or what is to be known about it
  /// s, of "never": it did not happen before; of a difference with it: its size is at least this
  double known_until = 0;
  std::map<std::int64_t, double> by_seed;  ///< empty for what has no value per seed
};

/// Takes one measure. Every run of its variants must have reached the times it needs and none may
/// have failed; otherwise there is no value.
Measured take_measure(const StudyPlan& plan, const StudyData& data, const StudyMeasure& measure);

/// The measure of a claim: one, or the difference or ratio of two, seed by seed where both variants
/// have the same seeds, else of the means.
Measured take_measure(const StudyPlan& plan, const StudyData& data, const StudyExpectation& claim);

/// Seeds whose value lies within the bounds, ends included.
int seeds_within(const Measured& measured, std::optional<double> low, std::optional<double> high);

}  // namespace acinus::runs
