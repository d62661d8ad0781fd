#include "calibration/compression.hpp"

#include <algorithm>
#include <numeric>

#include "coupling/measure/measure.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::calibration {
namespace {

/// Mean overlap d of the inner cells.
double mean_overlap(const ClumpSnapshot& snapshot, const std::vector<std::size_t>& inner) {
  double sum = 0;
  for (const std::size_t i : inner)
    for (std::size_t j = 0; j < snapshot.center.size(); ++j) {
      const double apart = (snapshot.center[i] - snapshot.center[j]).norm();
      if (j != i) sum += std::max(0.0, 1 - apart / (snapshot.radius[i] + snapshot.radius[j]));
    }
  return sum / (static_cast<double>(inner.size()) * cbm::kNeighbours);
}

}  // namespace

std::vector<std::size_t> find_inner_cells(const std::vector<ClumpSnapshot>& snapshots,
                                          const Vec3& point) {
  constexpr double kPressing = 0.1, kAway = 1.25;
  std::vector<double> force;
  for (const ClumpSnapshot& m : snapshots)
    force.push_back(std::accumulate(m.force.begin(), m.force.end(), 0.0));
  std::vector<std::size_t> inner;
  if (snapshots.empty()) return inner;
  const double enough = kPressing * *std::ranges::max_element(force);
  auto presses = std::ranges::find_if(force, [&](double f) { return f >= enough; });
  if (presses == force.end()) presses = std::ranges::max_element(force);  // all pull
  const ClumpSnapshot& snapshot = snapshots[presses - force.begin()];
  const auto distance = [&](std::size_t i) { return (snapshot.center[i] - point).norm(); };
  std::size_t middle = 0;
  for (std::size_t i = 0; i < snapshot.center.size(); ++i) {
    if (snapshot.capsule - distance(i) > kAway * snapshot.radius[i]) inner.push_back(i);
    if (distance(i) < distance(middle)) middle = i;
  }
  if (inner.empty() && !snapshot.center.empty()) inner.push_back(middle);
  return inner;
}

Bulk measure_bulk(const ClumpSnapshot& snapshot, const std::vector<std::size_t>& inner) {
  Bulk b{mean_overlap(snapshot, inner), 0};
  for (const std::size_t i : inner)
    b.force += snapshot.force[i] / static_cast<double>(inner.size());
  return b;
}

std::vector<Bulk> measure_bulks(const std::vector<ClumpSnapshot>& snapshots,
                                const std::vector<std::size_t>& inner) {
  std::vector<Bulk> bulks;
  for (const ClumpSnapshot& m : snapshots) bulks.push_back(measure_bulk(m, inner));
  return bulks;
}

ForceCurve force_curve(const std::vector<ClumpSnapshot>& snapshots,
                       const std::vector<std::size_t>& inner) {
  std::vector<double> overlap, force;
  for (const Bulk& b : measure_bulks(snapshots, inner)) {
    overlap.push_back(b.overlap);
    force.push_back(b.force);
  }
  return loading_branch(overlap, force);
}

std::vector<std::size_t> find_pressing(const std::vector<Bulk>& bulks, double highest) {
  constexpr double kPressing = 0.01;
  double largest = 0;
  for (const Bulk& b : bulks) largest = std::max(largest, b.force);
  std::vector<std::size_t> pressing;
  for (std::size_t k = 0; k < bulks.size(); ++k)
    if (bulks[k].force >= kPressing * largest && bulks[k].overlap <= highest) pressing.push_back(k);
  return pressing;
}

ClumpSnapshot as_spheres(const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                         const std::vector<std::size_t>& inner) {
  const double young =
      cbm::corrected_modulus(sphere.correction, sphere.young, mean_overlap(snapshot, inner)).value;
  std::vector<cbm::NewCell> cells;
  for (std::size_t k = 0; k < snapshot.center.size(); ++k)
    cells.push_back({static_cast<std::int64_t>(k), 1, snapshot.center[k], snapshot.radius[k], young,
                     Vec3::Zero()});
  for (const std::size_t k : inner) {
    cells[k].type = 0;
    cells[k].young = sphere.young;
  }
  coupling::World world;
  world.params.cbm = {sphere, sphere};
  world.params.cbm[1].correction = {};
  for (cbm::Params& p : world.params.cbm) p.cell_friction = 0;
  world.params.motility.random = false;
  world.state.cbm = cbm::make_state(cells);
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  ClumpSnapshot spheres = snapshot;
  spheres.force.clear();
  coupling::observe(world, work);
  for (const coupling::CellMeasure& c : coupling::measure_cells(world, work))
    spheres.force.push_back(c.normal_force);
  return spheres;
}

Bulk bulk_as_spheres(const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                     const std::vector<std::size_t>& inner) {
  return measure_bulk(as_spheres(snapshot, sphere, inner), inner);
}

}  // namespace acinus::calibration
