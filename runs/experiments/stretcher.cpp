#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "runs/experiments/experiment.hpp"

namespace acinus::runs {
namespace {

constexpr double kPa = 1e3;  // in a kPa
constexpr int kSides = 36;

/// Width of the points along a direction, um.
double extent(const std::vector<Vec3>& points, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : points) {
    low = std::min(low, x.dot(direction));
    high = std::max(high, x.dot(direction));
  }
  return high - low;
}

/// Mean width across an axis, um.
double extent_across(const std::vector<Vec3>& points, const Vec3& axis) {
  const Vec3 a = axis.unitOrthogonal(), b = axis.cross(a);
  double sum = 0;
  for (int k = 0; k < kSides; ++k) {
    const double angle = kPi * k / kSides;
    sum += extent(points, std::cos(angle) * a + std::sin(angle) * b);
  }
  return sum / kSides;
}

void add_axis(const std::string& name, double value, Measures& m) {
  m[name + "_um"].push_back(value);
  m[name + "_strain"].push_back(value / m[name + "_um"].front() - 1);
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void sample_stretcher(const Scene&, const coupling::World& world, const Snapshot& snapshot,
                      Measures& m) {
  const coupling::Params& p = world.params;
  const double t = snapshot.time;
  const dcm::StretchLoad load = coupling::stretch_at(p.stretcher, t);
  const bool there = world.state.dcm.n_lane() > 0 && world.state.dcm.active(0);
  std::vector<Vec3> node;
  if (there) dcm::copy_nodes(world.state.dcm, 0, node);
  add_axis("long_axis", there ? extent(node, load.axis) : kNone, m);
  add_axis("short_axis", there ? extent_across(node, load.axis) : kNone, m);
  m["stress_Pa"].push_back(kPa * load.stress);
  m["cortex_friction_factor"].push_back(coupling::friction_factor(p.temperature, t));
}

}  // namespace acinus::runs
