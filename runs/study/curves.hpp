#pragma once
/// Numbers over time, and the statistics of a few of them.

#include <optional>
#include <vector>

namespace acinus::runs {

/// What one run measured; times rise, all values are finite.
struct TimeCurve {
  std::vector<double> time;  ///< s
  std::vector<double> value;
};

/// Between two samples the values are joined by straight lines; nothing outside the samples.
std::optional<double> value_at(const TimeCurve& curve, double time);

/// When the curve is first at or beyond a level; nothing if it never is within [from, until].
/// @param below  at or below it, else at or above
std::optional<double> first_passage(const TimeCurve& curve, double level, bool below, double from,
                                    double until);

/// The curve within [from, until], with ends put in between samples; empty if that is not all
/// within the samples.
TimeCurve window(const TimeCurve& curve, double from, double until);

/// Mean over time; of a single sample that sample. @pre not empty
double time_mean(const TimeCurve& curve);

/// Two-sided p value of Welch's t-test: how often means would differ so much by chance. Nothing for
/// samples of fewer than two, or without any spread.   [Welch1947]
std::optional<double> welch_p(const std::vector<double>& a, const std::vector<double>& b);

/// The same for samples that belong together two by two: Student's t-test of the differences.
/// @pre as many of each
std::optional<double> paired_p(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace acinus::runs
