#include <vector>

#include "runs/experiments/experiment.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

constexpr double kPa = 1e3;  // in a kPa
void add_axis(const std::string& name, double value, Measures& m) {
  m[name + "_um"].push_back(value);
  m[name + "_strain"].push_back(value / m[name + "_um"].front() - 1);
}

}  // namespace

void sample_stretcher(const Scene&, const coupling::World& world, const Snapshot& snapshot,
                      Measures& m) {
  const coupling::Apparatus& apparatus = world.params.apparatus;
  const double t = snapshot.time;
  const coupling::StretchLoad load = apparatus.get<coupling::Stretcher>().load_at(t);
  const std::vector<Vec3> node = first_cell(world);
  const bool there = !node.empty();
  add_axis("long_axis", there ? extent(node, load.axis) : kNotMeasured, m);
  add_axis("short_axis", there ? extent_across(node, load.axis) : kNotMeasured, m);
  m["stress_Pa"].push_back(kPa * load.stress);
  m["cortex_friction_factor"].push_back(apparatus.get<coupling::Temperature>().friction_factor(t));
}

}  // namespace acinus::runs
