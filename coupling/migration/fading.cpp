#include "coupling/migration/fading.hpp"

#include <algorithm>

#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

Vec3 compute_separation(const State& s, const CellIndex& cells, const FadingForce& f) {
  const Vec3 a = center_of(s, cells.at(f.a));
  return f.b == kNoPartner ? a : Vec3(a - center_of(s, cells.at(f.b)));
}

bool has_both(const CellIndex& cells, const FadingForce& f) {
  return cells.contains(f.a) && (f.b == kNoPartner || cells.contains(f.b));
}

}  // namespace

double left_of(const FadingForce& f, double time, const Vec3& apart) {
  return f.share.at(time) * std::max(0.0, 1 - (apart - f.apart).norm() / f.reach);
}

void add_fading_forces(const State& s, double time, CellForces& forces) {
  if (s.fading.empty()) return;
  const auto cells = index_cells(s);
  const auto add = [&](std::int64_t lineage, const Vec3& force) {
    const Cell& c = cells.at(lineage);
    (c.deformable ? forces.dcm[c.at] : forces.cbm[c.at]) += force;
  };
  for (const FadingForce& f : s.fading) {
    if (!has_both(cells, f)) continue;
    const Vec3 force = left_of(f, time, compute_separation(s, cells, f)) * f.force;
    add(f.a, force);
    if (f.b != kNoPartner) add(f.b, -force);
  }
}

void keep_fading(const State& before, State& s) {
  if (s.fading.empty()) return;
  const auto was = index_cells(before), is = index_cells(s);
  for (FadingForce& f : s.fading)
    if (has_both(was, f) && has_both(is, f))
      f.apart += compute_separation(s, is, f) - compute_separation(before, was, f);
}

void forget_faded(State& s) {
  if (s.fading.empty()) return;
  const auto cells = index_cells(s);
  std::erase_if(s.fading, [&](const FadingForce& f) {
    return s.clock.time >= f.share.end || !has_both(cells, f);
  });
}

}  // namespace acinus::coupling
