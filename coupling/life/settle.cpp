#include <algorithm>

#include "coupling/life/division.hpp"
#include "coupling/subworld.hpp"

namespace acinus::coupling {
namespace {

/// Gap, um, up to which a cell counts as a neighbour of another.
constexpr double kReach = 0.5;
/// How long new daughters settle ahead of all others, in steps of the whole world: long enough that
/// what is stiff has come to rest, and nothing next to the time in which tissue flows.
constexpr double kSteps = 1;

}  // namespace

Settled settle_daughters(World& world, const std::vector<std::int64_t>& daughters) {
  const State& s = world.state;
  Selected born;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (std::ranges::find(daughters, s.dcm.lineage[l]) != daughters.end()) born.dcm.push_back(l);
  const Selected near = find_neighbours(world, born, kReach);
  Selected moving = near;
  moving.dcm.insert(moving.dcm.end(), born.dcm.begin(), born.dcm.end());
  std::ranges::sort(moving.dcm);
  Subworld sub = extract(world, moving, find_neighbours(world, moving, kReach));
  const Settling settling = relax(sub, kSteps * world.params.numerics.max_step);
  Settled result{settling.ok, settling.cause, settling.steps, 0, 0};
  if (!settling.ok) return result;

  std::vector<std::vector<Vec3>> before(near.dcm.size());
  for (std::size_t k = 0; k < near.dcm.size(); ++k) dcm::copy_nodes(s.dcm, near.dcm[k], before[k]);
  write_back(sub, world);
  std::vector<Vec3> node;
  for (std::size_t k = 0; k < near.dcm.size(); ++k) {
    dcm::copy_nodes(s.dcm, near.dcm[k], node);
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < node.size(); ++i) {
      const Vec3 shift = node[i] - before[k][i];
      mean += shift / static_cast<double>(node.size());
      result.node_shift = std::max(result.node_shift, shift.norm());
    }
    result.neighbour_shift = std::max(result.neighbour_shift, mean.norm());
  }
  return result;
}

}  // namespace acinus::coupling
