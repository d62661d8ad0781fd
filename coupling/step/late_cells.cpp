#include "coupling/step/late_cells.hpp"

#include "core/sort_unique.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// True if cells may take steps of their own.
bool can_have_late_cells(const World& world, const Workspace& w) {
  const Numerics& n = world.params.numerics;
  return n.adaptive && n.integrator == Integrator::kLinearlyImplicit &&
         !w.constraint.prescribed_velocity && !(world.params.motility.leader_force > 0) &&
         world.state.tree.node.empty();
}

}  // namespace

std::vector<std::size_t> find_late_cells(const World& world, double step, const Assessment& a,
                                         Workspace& w) {
  const State& s = world.state;
  const bool is_rejected = !a.accepted && a.usable > 0;
  const bool is_inaccurate = a.accepted && a.error > kErrorAim * world.params.numerics.tolerance;
  if (!(is_rejected || is_inaccurate) || !can_have_late_cells(world, w)) return {};
  const double most = kMostLate * static_cast<double>(count_cells(s));
  if (most < 1) return {};
  std::vector<std::size_t> own = find_limiting_cells(world, step, w), late;
  world.ranks.gather<std::size_t>(own, late);
  sort_unique(late);
  const bool has_spheres = !late.empty() && late.back() >= s.dcm.n_lane();
  if (has_spheres || static_cast<double>(late.size()) > most) late.clear();
  return late;
}

void mark_late(std::span<const std::size_t> lanes, Workspace& w) {
  w.late.assign(w.system.block.size() * kLanes, 0);
  for (const std::size_t lane : lanes) w.late[lane] = 1;
}

}  // namespace acinus::coupling
