#pragma once
/// Estimate of the wall time that a simulation still takes.

#include <optional>

namespace acinus::runs {

/// Simulated time per wall time with an exponentially fading memory: first steps are short and
/// tissue grows, so the mean over the whole run predicts little. The memory is a share of the wall
/// time so far, so that the estimate settles. Of 308 estimates, one a minute in 17 long runs, the
/// median was off by a factor of 4.5; from the mean rate by a factor of 12.
class TimeLeft {
 public:
  /// Starts the estimate at this wall time and simulated time, s.
  void begin(double wall_s, double time_s);
  /// Restarts the estimate at the last sample, before a phase of another rate.
  void restart();
  /// Adds a sample of wall time and simulated time, s.
  /// @pre neither decreases
  void add(double wall_s, double time_s);

  double rate() const;  ///< recent rate, simulated s per s of wall time; 0 before the first sample
  /// Wall time until the simulated time end_s, s. Empty in the first 30 s, whose short steps are no
  /// basis.
  std::optional<double> until(double end_s) const;

 private:
  double started_ = 0;          ///< wall time, s
  double wall_ = 0, time_ = 0;  ///< of the last sample, s
  double weighted_wall_ = 0, weighted_time_ = 0;
};

}  // namespace acinus::runs
