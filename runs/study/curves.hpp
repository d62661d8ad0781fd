#pragma once
/// Time series of observables, and test statistics of small samples.

#include <optional>
#include <vector>

namespace acinus::runs {

/// Time series of one observable in one run; times ascend and values are finite.
struct TimeCurve {
  std::vector<double> time;  ///< s
  std::vector<double> value;
};

/// Linear interpolation at a time (s); empty outside the samples.
std::optional<double> value_at(const TimeCurve& curve, double time);

/// First time within [from, until] at which the curve reaches a level, s; empty if it never does.
/// @param below  reach it from above (at or below the level), else at or above
std::optional<double> first_passage(const TimeCurve& curve, double level, bool below, double from,
                                    double until);

/// Part of the curve within [from, until], with interpolated ends; empty if the samples do not
/// cover it.
TimeCurve window(const TimeCurve& curve, double from, double until);

/// Time average by the trapezoidal rule; of a single sample its value.
double time_mean(const TimeCurve& curve);

/// Two-sided p value of Welch's t-test for different means [Welch1947]. Empty for samples of fewer
/// than two values, or without variance.
std::optional<double> welch_p(const std::vector<double>& a, const std::vector<double>& b);

/// Two-sided p value of the paired t-test.
/// @pre samples of equal size, paired by index
std::optional<double> paired_p(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace acinus::runs
