#include "coupling/apparatus/pull/pull.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "coupling/apparatus/pull/pull_spring.hpp"
#include "dcm/loads/loads.hpp"

namespace acinus::coupling {
namespace {

/// Spring on a cell; zero stiffness without one.
PullSpring spring_of(const std::vector<Pull>& pulls, std::int64_t lineage, double time) {
  PullSpring spring;
  for (const Pull& p : pulls)
    if (p.stiffness > 0 && p.cell == lineage)
      spring = {p.direction, p.stiffness, spring_end(p, time)};
  return spring;
}

}  // namespace

bool Pulls::any_spring() const {
  return std::ranges::any_of(pull, [](const Pull& p) { return p.stiffness > 0; });
}

double Pulls::next_change(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Pull& p : pull) next = std::min({next, p.force.next(time), p.displacement.next(time)});
  return next;
}

void Pulls::add_cell_forces(double time, const ForcedCells& cells) const {
  const auto add = [](const auto& state, const Pull& p, const Vec3& force, std::span<Vec3> to) {
    if (const auto at = std::ranges::find(state.lineage, p.cell); at != state.lineage.end())
      to[at - state.lineage.begin()] += force;
  };
  for (const Pull& p : pull) {
    if (p.force.entry.empty()) continue;
    const Vec3 force = p.force.at(time) * p.direction;
    add(cells.dcm, p, force, cells.dcm_force);
    add(cells.cbm, p, force, cells.cbm_force);
  }
}

void Pulls::add_loads(double time, const LoadedCells& cells, std::span<solve::RankOne> own) const {
  if (time < 0 || !any_spring()) return;
  const auto add = [&](const dcm::GroupView& g) {
    std::array<PullSpring, kLanes> spring;
    for (std::size_t l = 0; l < kLanes; ++l)
      spring[l] = spring_of(pull, cells.state.lineage[g.index * kLanes + l], time);
    add_pull_springs(g, spring, cells.system, own.front());
  };
  dcm::for_each_loaded_group(cells.state, cells.lanes, cells.system, add);
}

}  // namespace acinus::coupling
