#include "runs/session/time_left.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::runs {
namespace {

constexpr double kLeastWallTime = 30;  ///< least wall time, s
constexpr double kMemoryShare = 0.3;   ///< share of the wall time so far

}  // namespace

void TimeLeft::begin(double wall_s, double time_s) {
  wall_ = wall_s;
  time_ = time_s;
  restart();
}

void TimeLeft::restart() {
  started_ = wall_;
  weighted_wall_ = weighted_time_ = 0;
}

void TimeLeft::add(double wall_s, double time_s) {
  const double memory = std::max(kLeastWallTime, kMemoryShare * (wall_s - started_));
  const double fade = std::exp(-(wall_s - wall_) / memory);
  weighted_wall_ = fade * weighted_wall_ + wall_s - wall_;
  weighted_time_ = fade * weighted_time_ + time_s - time_;
  wall_ = wall_s;
  time_ = time_s;
}

double TimeLeft::rate() const { return weighted_wall_ > 0 ? weighted_time_ / weighted_wall_ : 0; }

std::optional<double> TimeLeft::until(double end_s) const {
  if (wall_ - started_ < kLeastWallTime || rate() <= 0) return std::nullopt;
  return std::max(0.0, end_s - time_) / rate();
}

}  // namespace acinus::runs
