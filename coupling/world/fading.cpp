#include "coupling/world/fading.hpp"

#include <unordered_map>

#include "coupling/world/cell.hpp"
#include "coupling/world/migration.hpp"

namespace acinus::coupling {
namespace {

/// Where cells stand, by lineage.
std::unordered_map<std::int64_t, Cell> find_cells(const State& s) {
  std::unordered_map<std::int64_t, Cell> cells;
  for_each_cell(s, [&](const Cell& c) { cells.emplace(lineage_of(s, c), c); });
  return cells;
}

bool has_both(const std::unordered_map<std::int64_t, Cell>& cells, const FadingForce& f) {
  return cells.contains(f.a) && (f.b == kNoPartner || cells.contains(f.b));
}

}  // namespace

void add_fading_forces(const State& s, double time, CellForces& forces) {
  if (s.fading.empty()) return;
  const auto cells = find_cells(s);
  const auto add = [&](std::int64_t lineage, const Vec3& force) {
    const Cell& c = cells.at(lineage);
    (c.deformable ? forces.dcm : forces.cbm)[c.at] += force;
  };
  for (const FadingForce& f : s.fading) {
    if (!has_both(cells, f)) continue;
    const Vec3 force = f.share.at(time) * f.force;
    add(f.a, force);
    if (f.b != kNoPartner) add(f.b, -force);
  }
}

void forget_faded(State& s) {
  if (s.fading.empty()) return;
  const auto cells = find_cells(s);
  std::erase_if(s.fading, [&](const FadingForce& f) {
    return s.clock.time >= f.share.end || !has_both(cells, f);
  });
}

}  // namespace acinus::coupling
