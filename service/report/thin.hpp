#pragma once
/// Decimation of frames and curves for display.

#include <vector>

#include "runs/study/curves.hpp"

namespace acinus::service {

/// Up to n evenly spaced integers from 0 to count - 1, including the first and the last (n = 1: the
/// last).
std::vector<int> choose_evenly(int count, int n);

/// Decimates a curve to at most n samples, keeping minimum and maximum of every stretch.
runs::TimeCurve thin_curve(const runs::TimeCurve& curve, int n);

/// Quantile of sorted values, interpolated linearly.
/// @param share  0 to 1
/// @pre sorted, not empty
double quantile(const std::vector<double>& sorted, double share);

}  // namespace acinus::service
