#pragma once
/// Error estimate of a step from the change of velocity.

#include <span>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Estimated errors of points, um: half the change of velocity times the step. A first step is
/// compared with rest. With random motility the mean of every cell is left out: it is white noise,
/// integrated exactly.
class PointErrors {
 public:
  /// Uses scratch of the solver.   @pre work outlives it
  PointErrors(const World& world, double step, Workspace& work);

  /// Calls f(error) for the points of an own cell.
  /// @param first    address of its first point
  /// @param n_point  their number
  template <class F>
  void for_each(Address first, int n_point, const F& f) const {
    const auto at = [&](int i) {
      return load_point(change_.data(), first + static_cast<Address>(i * kPointStride));
    };
    Vec3 mean = Vec3::Zero();
    if (noise_) {
      for (int i = 0; i < n_point; ++i) mean += at(i);
      mean /= n_point;
    }
    for (int i = 0; i < n_point; ++i) f(Vec3(at(i) - mean));
  }

 private:
  std::span<const double> change_;  ///< [n_row][3][lane] um
  bool noise_;
};

/// Estimated error, um: the larger of the rms of the errors of points and of the largest of them
/// over kMostOverMean.
double estimate_error(const World& world, double step, Workspace& work);
inline constexpr double kMostOverMean = 5;

}  // namespace acinus::coupling
