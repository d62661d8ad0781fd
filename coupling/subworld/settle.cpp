#include "coupling/subworld/settle.hpp"

#include <algorithm>
#include <utility>

#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/subworld.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

/// Largest gap, um, of neighbours included in the subworld.
constexpr double kSettleReach = 0.5;
/// Longest settling time of new cells, s: long enough for stiff modes to relax, negligible against
/// the flow of tissue. No longer than a step of the whole world.
constexpr double kLongest = 60;
constexpr int kNewtonSteps = 3;
/// Error of a step that is not controlled, um: more than any new mesh moves.
constexpr double kAnyError = 10;

double pressure_of(const World& world, std::size_t lane, const std::vector<Vec3>& node) {
  const State& s = world.state;
  const dcm::Group& group = s.dcm.group[lane / kLanes];
  return dcm::cytosol_pressure(world.params.dcm[group.type].bulk_modulus,
                               geometry::compute_volume(node, group.topology->triangle),
                               s.dcm.volume[lane].at(s.clock.time));
}

/// Makes the steps of a subworld equal and uncontrolled.   @param step  s
void set_newton_steps(double step, Subworld& sub) {
  Numerics& n = sub.world.params.numerics;
  n.max_step = step;
  n.tolerance = kAnyError;
  n.extrapolate = false;
  sub.world.state.clock.step = step;
}

CellSet find_cells(const State& s, const std::vector<std::int64_t>& lineages) {
  CellSet found;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (std::ranges::find(lineages, s.dcm.lineage[l]) != lineages.end()) found.dcm.push_back(l);
  return found;
}

/// Steps a subworld and writes its moving cells back.
Settled settle(Subworld& sub, double duration, World& world) {
  const Settling settling = relax(sub, duration);
  Settled result{settling.ok, settling.cause, settling.steps, {}, {}};
  if (!settling.ok) return result;

  const State& s = world.state;
  const std::vector<std::size_t>& moving = sub.moving.dcm;
  std::vector<std::vector<Vec3>> before(moving.size());
  for (std::size_t k = 0; k < moving.size(); ++k) dcm::copy_nodes(s.dcm, moving[k], before[k]);
  write_moved(sub, world.state);
  std::vector<Vec3> node;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const std::size_t lane = moving[k];
    dcm::copy_nodes(s.dcm, lane, node);
    double& shift = result.shift[s.dcm.lineage[lane]];
    for (std::size_t i = 0; i < node.size(); ++i)
      shift = std::max(shift, (node[i] - before[k][i]).norm());
    result.pressure[s.dcm.lineage[lane]] = pressure_of(world, lane, node);
  }
  return result;
}

}  // namespace

Settled settle_cells(World& world, const std::vector<std::int64_t>& cells) {
  const CellSet fresh = find_cells(world.state, cells);
  Subworld sub;
  extract_at_rest(world, fresh, find_neighbours(world, fresh, kSettleReach), sub);
  return settle(sub, std::min(kLongest, world.params.numerics.max_step), world);
}

Settled settle_shapes(World& world, std::vector<HeldCentroid> cells, double step) {
  std::vector<std::int64_t> lineages;
  for (const HeldCentroid& c : cells) lineages.push_back(c.cell);
  const CellSet fresh = find_cells(world.state, lineages);
  Subworld sub;
  extract_at_rest(world, fresh, find_neighbours(world, fresh, kSettleReach), sub);
  sub.world.params.apparatus.add(CenterHold(std::move(cells)));
  size_workspace(sub.world, sub.work);
  set_newton_steps(step, sub);
  return settle(sub, kNewtonSteps * step, world);
}

}  // namespace acinus::coupling
