#pragma once
/// Worlds whose cells change their model, and what such a change does at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "coupling/measure/contact_forces.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/zoom/update.hpp"
#include "geometry/measures.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {

/// Clump of n^3 cells, those of `deformable` as meshes, at rest in a capsule that compresses it.
inline World make_clump_world(int n, double distance, const std::function<bool(int)>& deformable) {
  std::vector<TestCell> cells;
  const double middle = 0.5 * (n - 1);
  for (int k = 0; k < n * n * n; ++k)
    cells.push_back(
        {distance * (Vec3(k % n, k / n % n, k / n / n) - Vec3::Constant(middle)), deformable(k)});
  World w = make_test_world(cells);
  w.params.numerics.adaptive = true;
  w.params.zoom.grid = 600;
  w.params.zoom.stay = 0;
  w.params.zoom.mesh = {&geometry::shared_icosphere(162)};
  return w;
}

inline void run(World& w, Workspace& work, double duration) {
  const double end = w.state.clock.time + duration;
  while (w.state.clock.time < end - 1e-9)
    ASSERT_TRUE(take_step(w, work, end - w.state.clock.time).accepted);
}

inline std::map<std::int64_t, CellMeasure> measure(const World& w, Workspace& work) {
  observe(w, work);
  std::map<std::int64_t, CellMeasure> cells;
  for (const CellMeasure& m : measure_cells(w, work)) cells[m.id] = m;
  return cells;
}

inline Region ball(const Vec3& center, double radius) {
  Region r;
  r.kind = RegionKind::kSphere;
  r.center = center;
  r.radius = radius;
  return r;
}

/// Immediate effect of the change of model of one cell.
struct Jump {
  EventKind kind{};         ///< kPromotion, kPromotionWaits or kDemotion
  double before = 0;        ///< kPa, its pressure
  double pressure = 0;      ///< kPa, change of it
  double force = 0;         ///< of a pair with a neighbour, largest change over the mean force
  double contact = 0;       ///< the same without what fades
  double shift = 0;         ///< um
  double volume_error = 0;  ///< change of the reference volume, um^3
  double ms = 0;            ///< milliseconds
};

/// Normal forces of a cell's pairs, nN, with what fades and without.
inline std::array<std::map<std::int64_t, double>, 2> pair_forces_of(const World& w, Workspace& work,
                                                                    std::int64_t cell) {
  observe(w, work);
  std::vector<std::int64_t> lineage;
  for (const std::size_t lane : work.dcm.lane_of_body) lineage.push_back(w.state.dcm.lineage[lane]);
  lineage.insert(lineage.end(), w.state.cbm.lineage.begin(), w.state.cbm.lineage.end());
  std::map<std::int64_t, Vec3> center;
  for_each_cell(w.state,
                [&](const Cell& c) { center[lineage_of(w.state, c)] = center_of(w.state, c); });
  std::array<std::map<std::int64_t, double>, 2> sums;
  visit_contacts(w, work, [&](const ContactForce& f) {
    if (f.b == kNoCell || f.a == f.b) return;
    const std::int64_t a = lineage[f.a], b = lineage[f.b];
    if (a != cell && b != cell) return;
    const double normal = f.force.dot((center[a] - center[b]).normalized());
    sums[0][a == cell ? b : a] += normal;
    if (!f.fades) sums[1][a == cell ? b : a] += normal;
  });
  return sums;
}

inline Vec3 volume_center(const World& w, std::int64_t cell) {
  Vec3 center = Vec3::Zero();
  for_each_cell(w.state, [&](const Cell& c) {
    if (lineage_of(w.state, c) != cell) return;
    center = center_of(w.state, c);
    if (!c.deformable) return;
    std::vector<Vec3> node;
    dcm::copy_nodes(w.state.dcm, c.at, node);
    center = geometry::compute_centroid(node, w.state.dcm.group[c.at / kLanes].topology->triangle);
  });
  return center;
}

/// Makes one cell change its model, whatever it is.
inline Jump change_one(World& w, Workspace& work, std::int64_t cell) {
  const auto before = measure(w, work);
  const auto forces = pair_forces_of(w, work, cell);
  const bool deformable = before.at(cell).deformable;
  const Vec3 place = volume_center(w, cell);
  Region r;
  r.kind = RegionKind::kCells;
  r.offspring = false;
  r.max_distance = 1e-3;
  for (const auto& [id, m] : before)
    if (deformable ? m.deformable && id != cell : id == cell) r.cells.push_back(id);
  w.params.zoom.region = {r};
  w.params.zoom.margin = deformable ? 1e-3 : 1e9;
  const auto volume = [&] {
    double v = 0;
    for_each_cell(w.state, [&](const Cell& c) {
      if (lineage_of(w.state, c) == cell) v = volume_of(w.state, c).at(w.state.clock.time);
    });
    return v;
  };
  const double rest = volume();
  const auto start = std::chrono::steady_clock::now();
  const ZoomReport report = update_zoom(w, work);
  Jump jump;
  jump.ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(report.changes.size(), 1u);
  if (report.changes.size() != 1) return jump;
  jump.kind = report.changes[0].kind;
  jump.volume_error = std::abs(volume() - rest);
  const auto after = measure(w, work);
  const auto now = pair_forces_of(w, work, cell);
  jump.before = before.at(cell).pressure;
  jump.pressure = after.at(cell).pressure - jump.before;
  jump.shift = (volume_center(w, cell) - place).norm();
  double mean = 0;
  for (const auto& [id, force] : forces[0])
    mean += std::abs(force) / static_cast<double>(forces[0].size());
  for (std::size_t k = 0; k < 2; ++k) {
    double& largest = k == 0 ? jump.force : jump.contact;
    for (const auto& [id, force] : now[k]) {
      const auto old = forces[0].find(id);
      largest =
          std::max(largest, std::abs(force - (old == forces[0].end() ? 0 : old->second)) / mean);
    }
  }
  return jump;
}

}  // namespace acinus::coupling
