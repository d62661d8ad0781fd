#pragma once
/// Fewer of many, so that what is looked at stays the same.

#include <vector>

#include "runs/study/curves.hpp"

namespace acinus::runs {

/// Up to n of the numbers 0 to count - 1, evenly spaced, with the first and the last (n = 1: the
/// last).
std::vector<int> choose_evenly(int count, int n);

/// At most n samples that look alike when drawn: of every stretch its smallest and largest.
TimeCurve thin_curve(const TimeCurve& curve, int n);

/// Value below which this share of the values lies; between two of them it is joined by a straight
/// line.   @pre sorted, not empty; share 0 to 1
double quantile(const std::vector<double>& sorted, double share);

}  // namespace acinus::runs
