#include "coupling/subworld/settle.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel/stop.hpp"
#include "core/sphere.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
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

/// Largest shift that is taken back, over the radius: a mesh that is pushed farther stays there.
constexpr double kMostReturn = 0.05;
/// Step after the way back, s: so short that cells stay there, long enough for stiff contacts.
constexpr double kReturnStep = 30;

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

std::vector<Vec3> centroids(const Subworld& sub) {
  const dcm::State& s = sub.world.state.dcm;
  std::vector<Vec3> centroid, node;
  for (const std::size_t lane : sub.lane) {
    dcm::copy_nodes(s, lane, node);
    centroid.push_back(geometry::compute_centroid(node, s.group[lane / kLanes].topology->triangle));
  }
  return centroid;
}

/// Moves cells back by small shifts of their centroids and settles them for a short step. Their
/// shapes stay free. After a failure they keep the places they had.
/// @return false if the process was asked to stop
bool return_cells(const std::vector<Vec3>& start, Subworld& sub) {
  const State settled = sub.world.state;
  dcm::State& s = sub.world.state.dcm;
  const std::vector<Vec3> now = centroids(sub);
  for (std::size_t k = 0; k < now.size(); ++k) {
    const std::size_t lane = sub.lane[k];
    const double most = kMostReturn * sphere_radius(s.volume[lane].from);
    const Vec3 back = start[k] - now[k];
    if (back.norm() > most) continue;
    for (int i = 0; i < s.group[lane / kLanes].n_point(); ++i)
      add_point(s.position.data(), dcm::node_address(s, lane, i), back);
  }
  sub.world.state.clock.step = kReturnStep;
  if (relax(sub, kReturnStep).ok) return true;
  sub.world.state = settled;
  return !stop_requested();
}

}  // namespace

Settled settle_cells(World& world, const std::vector<std::int64_t>& cells, double newton_step,
                     bool return_centers) {
  const State& s = world.state;
  CellSet fresh;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (std::ranges::find(cells, s.dcm.lineage[l]) != cells.end()) fresh.dcm.push_back(l);
  complete_contacts(world.ranks, world.state);
  Subworld sub;
  CellSet neighbours = find_neighbours(world, fresh, kSettleReach);
  bring_points(world.ranks, lanes_of(s, neighbours), world.state);
  extract_at_rest(world, fresh, std::move(neighbours), sub);
  if (newton_step > 0) set_newton_steps(newton_step, sub);
  const double duration = newton_step > 0 ? kNewtonSteps * newton_step
                                          : std::min(kLongest, world.params.numerics.max_step);
  const std::vector<Vec3> start = centroids(sub);
  Settling settling = relax(sub, duration);
  if (settling.ok && return_centers) settling.ok = return_cells(start, sub);
  Settled result{settling.ok, settling.cause, settling.steps, {}, {}};
  if (!settling.ok) return result;

  std::vector<std::vector<Vec3>> before(fresh.dcm.size());
  for (std::size_t k = 0; k < fresh.dcm.size(); ++k)
    dcm::copy_nodes(s.dcm, fresh.dcm[k], before[k]);
  write_moved(sub, world.state);
  std::vector<Vec3> node;
  for (std::size_t k = 0; k < fresh.dcm.size(); ++k) {
    const std::size_t lane = fresh.dcm[k];
    dcm::copy_nodes(s.dcm, lane, node);
    double& shift = result.shift[s.dcm.lineage[lane]];
    for (std::size_t i = 0; i < node.size(); ++i)
      shift = std::max(shift, (node[i] - before[k][i]).norm());
    result.pressure[s.dcm.lineage[lane]] = pressure_of(world, lane, node);
  }
  return result;
}

}  // namespace acinus::coupling
