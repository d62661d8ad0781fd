#include "coupling/apparatus/suction/suction_load.hpp"

#include <algorithm>

namespace acinus::coupling {
namespace {

/// Positive part of a triangle with only corner `k` of its sign.
std::array<double, 3> corner_part(const std::array<double, 3>& height, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double to_i = height[k] / (height[k] - height[i]),
               to_j = height[k] / (height[k] - height[j]);
  const double share = to_i * to_j;
  std::array<double, 3> part{};
  part[i] = share * to_i / 3;
  part[j] = share * to_j / 3;
  part[k] = share - part[i] - part[j];
  return part;
}

}  // namespace

std::array<double, 3> positive_part(const std::array<double, 3>& height) {
  constexpr double kThird = 1.0 / 3;
  const auto n = std::ranges::count_if(height, [](double h) { return h > 0; });
  if (n == 0) return {};
  if (n == 3) return {kThird, kThird, kThird};
  const auto alone = std::ranges::find_if(height, [n](double h) { return (h > 0) == (n == 1); });
  std::array<double, 3> part = corner_part(height, static_cast<int>(alone - height.begin()));
  if (n == 2)
    for (double& p : part) p = kThird - p;
  return part;
}

void add_suction_load(const dcm::GroupView& g, const SuctionLoad& load, solve::System& s) {
  for (int l = 0; l < kLanes; ++l) {
    if (g.active[l] == 0) continue;
    for (const auto& corner : g.topology->triangle) {
      std::array<Vec3, 3> x;
      std::array<double, 3> height{};
      for (int k = 0; k < 3; ++k) {
        x[k] = load_point(g.position, make_address(corner[k], l)) - load.mouth;
        height[k] = x[k].dot(load.axis);
      }
      if (*std::ranges::max_element(height) <= 0) continue;
      const Vec3 middle = (x[0] + x[1] + x[2]) / 3;
      if (middle.cross(load.axis).norm() > load.reach) continue;
      const std::array<double, 3> part = positive_part(height);
      const Vec3 force = 0.5 * load.pressure * (x[1] - x[0]).cross(x[2] - x[0]);
      for (int k = 0; k < 3; ++k)
        add_point(s.external_force.data(), make_address(g.first_row + corner[k], l),
                  part[k] * force);
    }
  }
}

}  // namespace acinus::coupling
