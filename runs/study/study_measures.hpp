#pragma once
/// Measures of the claims of a study.

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "runs/study/study_data.hpp"

namespace acinus::runs {

/// Measured value, or the reason why there is none.
struct Measured {
  std::optional<double> value;      ///< mean over seeds, or median if some are infinite (= never)
  std::optional<double> low, high;  ///< range over seeds; empty without values per seed
  std::string unit;
  std::string note;  ///< reason for a missing value, or remark on the value
  /// Time up to which an event is known not to have happened, s; for a difference with such an
  /// event, a lower bound of its size.
  double known_until = 0;
  std::map<std::int64_t, double> by_seed;  ///< empty without values per seed
};

/// Evaluates one measure. There is no value unless every run of its variants reached the times it
/// needs and none failed.
Measured take_measure(const StudyPlan& plan, const StudyData& data, const StudyMeasure& measure);

/// Evaluates a claim: one measure, or the difference or ratio of two, by seed if both variants have
/// the same seeds, else of the means.
Measured take_measure(const StudyPlan& plan, const StudyData& data, const StudyExpectation& claim);

/// Number of seeds whose value lies within the bounds, ends included.
int seeds_within(const Measured& measured, std::optional<double> low, std::optional<double> high);

}  // namespace acinus::runs
