#include "coupling/migration/migration.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers/random.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/migration/fading.hpp"
#include "coupling/migration/leaders.hpp"
#include "coupling/world/contact_input.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/terms/medium.hpp"

namespace acinus::coupling {
namespace {

/// Number of cells below which threads cost more than they save.
constexpr std::size_t kParallelCells = 1000;

Vec3 toward_axis(const Motility& m, const Vec3& center) {
  Vec3 d = m.axis_point - center;
  d.z() = 0;
  const double r = d.norm();
  return r > 0 ? Vec3(d / r) : Vec3::Zero();
}

void choose_step_leaders(const World& world, const State& at, Workspace& w) {
  w.leader = at.leader;
  w.leader_interval = at.leader_interval;
  if (world.params.motility.leader_force > 0 && world.state.clock.phase == Phase::kRun)
    choose_leaders(world.params, at, w.lanes.radius, w.cbm_radius, w.leader, w.leader_interval);
}

/// Total friction of every cell with the medium, nN s/um.
void sum_medium_friction(const World& world, const InterfaceInput& in, Workspace& w) {
  constexpr double kOfOtherProcess = -1;
  const dcm::State& shells = in.dcm.state;
  const cbm::State& spheres = in.cbm.state;
  dcm::compute_medium_areas(in.dcm, w.dcm, w.medium_area);
  w.medium_friction.dcm.assign(shells.n_lane(), 0.0);
  for (std::size_t l = 0; l < shells.n_lane(); ++l) {
    if (w.dcm.is_ghost(l)) w.medium_friction.dcm[l] = kOfOtherProcess;
    if (!shells.active(l) || w.dcm.is_ghost(l)) continue;
    const dcm::Group& g = shells.group[l / kLanes];
    double area = 0;
    for (int i = 0; i < g.topology->n_node; ++i)
      area += w.medium_area[(g.first_row + i) * kLanes + l % kLanes];
    w.medium_friction.dcm[l] =
        area * dcm::medium_friction_per_area(world.params.dcm[g.type], w.lanes.radius[l],
                                             g.topology->rest_area);
  }
  set_size(w.medium_friction.cbm, spheres.n_cell());
  w.medium_friction.ghost = w.cbm.ghost;
  for (std::size_t c = 0; c < spheres.n_cell(); ++c)
    if (!w.cbm.is_ghost(c))
      w.medium_friction.cbm[c] = cbm::medium_friction(world.params.cbm[spheres.type[c]],
                                                      w.cbm_radius[c], w.cbm.contact_area[c]);
}

}  // namespace

bool has_random_force(const World& world) {
  return world.params.motility.random &&
         controls_at(world.state.clock, world.params.start_up).motility;
}

Vec3 mean_random(std::uint64_t seed, std::int64_t lineage, double grid, double time, double step) {
  const auto first = static_cast<std::int64_t>(std::floor(time / grid));
  const double end = time + step;
  Vec3 sum = Vec3::Zero();
  for (std::int64_t k = first; static_cast<double>(k) * grid < end; ++k) {
    const double from = std::max(time, static_cast<double>(k) * grid);
    const double to = std::min(end, static_cast<double>(k + 1) * grid);
    if (to <= from) continue;
    sum += (to - from) * normal3({seed, Purpose::kMotility, static_cast<std::uint64_t>(lineage),
                                  static_cast<std::uint64_t>(k), 0});
  }
  return sum / step;
}

void compute_cell_forces(const World& world, const State& s, double step,
                         const MediumFriction& medium, std::span<const std::uint8_t> leader,
                         CellForces& forces) {
  const Motility& m = world.params.motility;
  forces.dcm.assign(s.dcm.n_lane(), Vec3::Zero());
  set_size(forces.cbm, s.cbm.n_cell());
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    if (!medium.is_ghost(c)) forces.cbm[c] = Vec3::Zero();
  if (!controls_at(s.clock, world.params.start_up).motility) return;
  const double time = s.clock.time - s.clock.origin;
  auto guide = [&](std::size_t index, const Vec3& center, Vec3& force) {
    if (!s.guidance.empty()) force += s.guidance[index].force;
    if (!(m.leader_force > 0) || leader[index] == 0) return;
    force += m.leader_force * (world.params.substances.leader_signal >= 0 && !s.guidance.empty()
                                   ? s.guidance[index].heading
                                   : toward_axis(m, center));
  };
  auto active = [&](std::size_t index, std::int64_t lineage, double diffusion, double friction) {
    if (!s.guidance.empty()) diffusion *= s.guidance[index].motility;
    if (!m.random || diffusion <= 0) return Vec3(Vec3::Zero());
    Vec3 force = friction * std::sqrt(2 * diffusion / m.grid) *
                 mean_random(m.seed, lineage, m.grid, time, step);
    if (m.in_plane) force.z() = 0;
    return force;
  };
  for_each_index(s.dcm.n_lane(), s.dcm.n_lane() > kParallelCells, [&](std::size_t l) {
    if (!s.dcm.active(l) || medium.dcm[l] < 0) return;
    const dcm::Params& p = world.params.dcm[s.dcm.group[l / kLanes].type];
    forces.dcm[l] = s.dcm.pull[l] + active(l, s.dcm.lineage[l], p.diffusion, medium.dcm[l]);
    guide(l, dcm::cell_center(s.dcm, l), forces.dcm[l]);
  });
  for_each_index(s.cbm.n_cell(), s.cbm.n_cell() > kParallelCells, [&](std::size_t c) {
    if (medium.is_ghost(c)) return;
    const cbm::Params& p = world.params.cbm[s.cbm.type[c]];
    forces.cbm[c] =
        s.cbm.pull[c] + active(s.dcm.n_lane() + c, s.cbm.lineage[c], p.diffusion, medium.cbm[c]);
    guide(s.dcm.n_lane() + c, cbm::center_of(s.cbm, c), forces.cbm[c]);
  });
  world.params.apparatus.add_cell_forces(time + 0.5 * step, {s.dcm, s.cbm, forces.dcm, forces.cbm});
  add_fading_forces(s, s.clock.time + 0.5 * step, forces);
}

void refresh_migration(const World& world, const State& at, double step, Workspace& w) {
  const auto scope = w.timings.scope("assembly");
  choose_step_leaders(world, at, w);
  const PhaseParams phase = phase_params(world);
  sum_medium_friction(world, contact_input(world, at, phase, 0, w), w);
  compute_cell_forces(world, at, step, w.medium_friction, w.leader, w.forces);
}

}  // namespace acinus::coupling
