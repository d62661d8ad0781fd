#include "runs/experiments/single_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acinus::runs {
namespace {

constexpr int kSides = 36;

}  // namespace

std::vector<Vec3> first_cell(const coupling::World& world) {
  std::vector<Vec3> node;
  if (world.state.dcm.n_lane() > 0 && world.state.dcm.active(0))
    dcm::copy_nodes(world.state.dcm, 0, node);
  return node;
}

double extent(std::span<const Vec3> points, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : points) {
    low = std::min(low, x.dot(direction));
    high = std::max(high, x.dot(direction));
  }
  return high - low;
}

double extent_across(std::span<const Vec3> points, const Vec3& axis) {
  const Vec3 a = axis.unitOrthogonal(), b = axis.cross(a);
  double sum = 0;
  for (int k = 0; k < kSides; ++k) {
    const double angle = kPi * k / kSides;
    sum += extent(points, std::cos(angle) * a + std::sin(angle) * b);
  }
  return sum / kSides;
}

}  // namespace acinus::runs
