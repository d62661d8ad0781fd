#include "core/implicit/vessel_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/mesh/segment_shape.hpp"

namespace acinus::implicit {

VesselField::VesselField(const mesh::Network& network, double rounding)
    : network_(network), rounding_(rounding) {
  for (const auto& [ra, rb] : network.radius)
    widest_crease_ = std::max({widest_crease_, rounding * ra, rounding * rb});
}

double VesselField::distance(const Vec3& x, int segment) const {
  const mesh::NearestBall ball = mesh::nearest_ball(network_, segment, x);
  return ball.apart.norm() - ball.radius;
}

double VesselField::crease(int s, int t) const {
  for (const std::size_t i : {0, 1})
    for (const std::size_t j : {0, 1}) {
      const int node = network_.segment[s][i];
      if (node != network_.segment[t][j]) continue;
      const auto leaving = [&](int segment, std::size_t end) {
        return (network_.node[network_.segment[segment][1 - end]] - network_.node[node])
            .normalized();
      };
      const double alike = leaving(s, i).dot(leaving(t, j));  // -1: straight on
      const double radius = std::min(network_.radius[s][i], network_.radius[t][j]);
      return rounding_ * radius * std::max(0.0, 0.5 * (1 + alike));
    }
  return 0;
}

double VesselField::value(const Vec3& x, std::span<const int> segments) const {
  thread_local std::vector<double> at;
  at.clear();
  double least = std::numeric_limits<double>::infinity();
  for (const int s : segments) least = std::min(least, at.emplace_back(distance(x, s)));
  // Smooth minimum of two with compact support: less than both by at most a quarter of the width.
  double rounded = least;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] >= least + widest_crease_) continue;
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      const double apart = std::abs(at[i] - at[j]);
      if (apart >= widest_crease_) continue;
      const double width = crease(segments[i], segments[j]);
      if (apart >= width) continue;
      const double more = (width - apart) * (width - apart) / (4 * width);
      rounded = std::min(rounded, std::min(at[i], at[j]) - more);
    }
  }
  return rounded;
}

}  // namespace acinus::implicit
