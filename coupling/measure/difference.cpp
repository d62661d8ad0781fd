#include "coupling/measure/difference.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/nearest_rotation.hpp"

namespace acinus::coupling {

double relative_error(std::span<const double> value, std::span<const double> reference) {
  ACINUS_ASSERT(value.size() == reference.size());
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < value.size(); ++k) {
    difference += (value[k] - reference[k]) * (value[k] - reference[k]);
    size += reference[k] * reference[k];
  }
  return difference == 0 ? 0 : std::sqrt(difference / size);
}

Distance aligned_distance(std::span<const Vec3> point, std::span<const Vec3> reference) {
  ACINUS_ASSERT(point.size() == reference.size());
  if (point.empty()) return {};
  const auto n = static_cast<double>(point.size());
  Vec3 middle = Vec3::Zero(), reference_middle = Vec3::Zero();
  for (std::size_t k = 0; k < point.size(); ++k) {
    middle += point[k] / n;
    reference_middle += reference[k] / n;
  }
  Mat3 covariance = Mat3::Zero();
  for (std::size_t k = 0; k < point.size(); ++k)
    covariance += (point[k] - middle) * (reference[k] - reference_middle).transpose();
  const Mat3 turn = geometry::nearest_rotation(covariance).transpose();
  Distance d;
  double sum = 0;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const double left = (turn * (point[k] - middle) - (reference[k] - reference_middle)).norm();
    d.max = std::max(d.max, left);
    sum += left * left;
  }
  d.rms = std::sqrt(sum / n);
  return d;
}

}  // namespace acinus::coupling
