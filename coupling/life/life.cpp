#include "coupling/life/life.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <span>

#include "cbm/division.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/life/announce_daughters.hpp"
#include "coupling/life/cell_cycle.hpp"
#include "coupling/life/mesh_health.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/sleep/sleep.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/near_cells.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/population.hpp"
#include "coupling/subworld/settle.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/zoom/update.hpp"
#include "dcm/shape/give_shape.hpp"
#include "dcm/tensions.hpp"

namespace acinus::coupling {
namespace {

/// Time to the next attempt after a failed division, s.
constexpr double kWait = 600;

/// Daughters to be made. Entry k of each list belongs to cell k.
struct Newborn {
  std::vector<dcm::NewCell> shell;
  std::vector<std::vector<Vec3>> node;
  std::vector<double> stretch;
  std::vector<double> tension;  ///< nN, mean over the edges of the mother
  std::vector<double> mitosis;  ///< s
  std::vector<Cycle> shell_cycle;
  std::vector<cbm::NewCell> sphere;
  std::vector<Cycle> sphere_cycle;
};

Cycle inherit(const World& world, const Cell& mother, std::int64_t lineage) {
  const State& s = world.state;
  const Cycle& m = s.cycle[mother.index];
  Cycle c;
  c.parent = lineage_of(s, mother);
  c.founder = m.founder;
  c.fate = world.params.life.proliferation ? Fate::kQuiescent : Fate::kGrow;
  c.birth = s.clock.time;
  c.birth_volume = m.birth_volume;
  c.duration = draw_cycle_time(cycle_of(world.params, s, mother), world.params.life.seed, lineage);
  return c;
}

std::string describe(const Vec3& axis) {
  return fmt::format("along ({:.3f}, {:.3f}, {:.3f})", axis.x(), axis.y(), axis.z());
}

void bear_spheres(World& world, const Cell& mother, Newborn& born, LifeReport& report) {
  State& s = world.state;
  const CycleParams& p = cycle_of(world.params, s, mother);
  const std::int64_t parent = lineage_of(s, mother);
  const Vec3 center = center_of(s, mother);
  const int type = type_of(s, mother);
  const double radius = sphere_radius(volume_of(s, mother).at(s.clock.time));
  const Vec3 axis = division_axis(world, p, parent, center, 0);
  const cbm::DaughterSpheres daughters =
      cbm::divide({center, radius, axis, 1, s.clock.time, p.force_ramp * p.time});
  for (const Vec3& place : daughters.center) {
    const std::int64_t id = s.next_lineage++;
    born.sphere_cycle.push_back(inherit(world, mother, id));
    born.sphere.push_back({id, type, place, daughters.radius,
                           cbm::draw_young(world.params.cbm[type], world.params.life.seed, id),
                           0.5 * s.cbm.pull[mother.at], daughters.strength});
  }
  report.events.push_back(
      {EventKind::kDivision, {parent, s.next_lineage - 2, s.next_lineage - 1}, describe(axis)});
}

void bear_shells(World& world, const Cell& mother, const DaughterMeshes& daughters, Newborn& born,
                 LifeReport& report) {
  State& s = world.state;
  const std::int64_t parent = lineage_of(s, mother);
  const dcm::Group& group = s.dcm.group[mother.at / kLanes];
  const double radius = sphere_radius(0.5 * volume_of(s, mother).at(s.clock.time));
  for (const std::vector<Vec3>& node : daughters.node) {
    const std::int64_t id = s.next_lineage++;
    born.shell_cycle.push_back(inherit(world, mother, id));
    born.shell.push_back({id, group.type, group.topology, Vec3::Zero(), radius,
                          0.5 * s.dcm.pull[mother.at], Mat3::Identity(), group.nucleus});
    born.node.push_back(node);
    born.stretch.push_back(daughters.stretch);
    born.tension.push_back(dcm::mean_tension(s.dcm.tension[mother.at]));
    born.mitosis.push_back(cycle_of(world.params, s, mother).mitosis);
  }
  const DivisionFigures& f = daughters.figures;
  report.events.push_back(
      {EventKind::kDivision,
       {parent, s.next_lineage - 2, s.next_lineage - 1},
       describe(daughters.axis) + fmt::format(", {} planes, {} steps, volume {:.1e}, outside "
                                              "{:.2f} um",
                                              f.planes, f.steps, f.volume_error, f.outside)});
  report.divisions.push_back(f);
}

/// State of the newborn cells alone.
State make_state(const World& world, const Newborn& born, double time) {
  State s;
  s.dcm = dcm::make_state(born.shell);
  s.cbm = cbm::make_state(born.sphere);
  s.cycle.assign(s.dcm.n_lane() + s.cbm.n_cell(), Cycle{});
  const CellIndex index = index_cells(s);
  for (std::size_t k = 0; k < born.shell.size(); ++k) {
    const std::size_t lane = index.at(born.shell[k].lineage).at;
    dcm::give_shape(
        world.params.dcm[born.shell[k].type],
        {born.node[k], born.shell[k].radius, born.stretch[k], {1, 0, time, time + born.mitosis[k]}},
        lane, s.dcm);
    if (born.tension[k] != 0)
      s.dcm.tension[lane] =
          dcm::make_tension(*born.shell[k].topology, born.node[k], born.tension[k]);
    s.cycle[lane] = born.shell_cycle[k];
  }
  for (std::size_t k = 0; k < born.sphere.size(); ++k)
    s.cycle[cell_index(s, k)] = born.sphere_cycle[k];
  return s;
}

void add_settling(const Settled& settled, const std::array<std::int64_t, 2>& daughters,
                  DivisionFigures& f) {
  f.steps += settled.steps;
  if (!settled.ok) return;
  for (const std::int64_t id : daughters) {
    f.settled_shift = std::max(f.settled_shift, settled.shift.at(id));
    f.settled_pressure_change =
        std::max(f.settled_pressure_change, std::abs(settled.pressure.at(id) - f.pressure));
  }
}

/// Lanes of the spheres among cells.
std::vector<std::size_t> spheres_of(const std::vector<Cell>& cells) {
  std::vector<std::size_t> lanes;
  for (const Cell& c : cells)
    if (!c.deformable) lanes.push_back(c.index);
  return lanes;
}

/// Divides all deformable mothers, each on the process that holds it, in parallel if there are
/// many.
void divide_shells(World& world, const std::vector<Cell>& mothers, Newborn& born,
                   std::vector<std::uint8_t>& gone, LifeReport& report) {
  std::vector<DaughterMeshes> daughters(mothers.size());
  std::vector<std::string> why(mothers.size());
  std::vector<std::uint8_t> done(mothers.size(), 0);
  for_each_part(mothers.size(), [&](std::size_t k) {
    if (stop_requested() || !is_mine(world, mothers[k])) return;
    try {  // one that fails does not keep the others from dividing
      done[k] = split_shell(world, mothers[k].at, daughters[k], why[k]) ? 1 : 0;
    } catch (const std::exception& e) {
      why[k] = e.what();
    }
  });
  if (!world.state.cell_holder.empty()) announce_daughters(world, mothers, done, daughters, why);
  for (std::size_t k = 0; k < mothers.size(); ++k) {
    State& s = world.state;
    if (done[k] != 0) {
      gone[mothers[k].index] = 1;
      bear_shells(world, mothers[k], daughters[k], born, report);
      continue;
    }
    s.cycle[mothers[k].index].wait_until = s.clock.time + kWait;
    report.events.push_back({EventKind::kDivisionWaits,
                             {lineage_of(s, mothers[k])},
                             fmt::format("no plane divides it cleanly: {}", why[k])});
  }
}

/// Starts the lysis of a cell.
void begin_lysis(World& world, const Cell& c, LifeReport& report) {
  State& s = world.state;
  const DeathParams& p = cycle_of(world.params, s, c).death;
  const double t = s.clock.time, volume = volume_of(s, c).at(t);
  volume_of(s, c) = {volume, p.final_volume * volume, t, t + p.duration};
  s.cycle[c.index].fate = Fate::kLyse;
  report.events.push_back({EventKind::kLysis, {lineage_of(s, c)}, "shrinks"});
}

LifeReport undo(State& before, State& s) {
  s = std::move(before);
  LifeReport nothing;
  nothing.interrupted = true;
  return nothing;
}

/// Runs division and death. Nothing changes if interrupted.
LifeReport turn_over(World& world, Workspace& work) {
  LifeReport report;
  if (world.state.cycle.empty()) return report;
  State before;
  if (reads_points(world)) complete_points(world, work);
  if (has_doubled_shell(world.state)) {
    release_solve(work);  // room for the three states that there are now
    before = world.state;
  }
  Plan plan = make_plan(world, work);
  if (plan.empty()) return report;
  const auto scope = work.timings.scope("life");
  State& s = world.state;
  bring_points(world.ranks, spheres_of(plan.divide), s);
  const std::int64_t first_new = s.next_lineage;
  std::vector<std::uint8_t> gone(s.cycle.size(), 0);
  std::vector<int> type(s.cycle.size(), -1);  // cells become
  Newborn born;
  for (const Cell& c : plan.remove) {
    gone[c.index] = 1;
    ++s.deaths;
    report.events.push_back({EventKind::kDeath, {lineage_of(s, c)}, "removed"});
  }
  for (const Cell& c : plan.lyse) {
    type[c.index] = cycle_of(world.params, s, c).death.type;
    begin_lysis(world, c, report);
  }
  // In order of lineage: births must not depend on storage order.
  std::ranges::sort(plan.divide, {}, [&](const Cell& c) { return lineage_of(s, c); });
  std::vector<Cell> shells;
  for (const Cell& c : plan.divide) {
    if (c.deformable) {
      shells.push_back(c);
      continue;
    }
    gone[c.index] = 1;
    bear_spheres(world, c, born, report);
  }
  divide_shells(world, shells, born, gone, report);
  if (!shells.empty() && stop_requested()) return undo(before, s);
  s.divisions += std::ssize(born.shell) / 2 + std::ssize(born.sphere) / 2;
  const State newborn = make_state(world, born, s.clock.time);
  exchange_cells(world.ranks, gone, type, {&newborn, 1}, s);
  for_each_cell(s, [&](const Cell& c) {  // new cells start to grow, or rest where a rule says so
    if (lineage_of(s, c) >= first_new) set_growth(world.params, s, c, 1);
  });
  if (!born.shell.empty()) {
    std::vector<std::int64_t> daughters;
    for (const dcm::NewCell& c : born.shell) daughters.push_back(c.lineage);
    const Settled settled = settle_cells(world, daughters);
    if (!settled.ok && stop_requested()) return undo(before, s);
    for (std::size_t k = 0; k < report.divisions.size(); ++k)
      add_settling(settled, {daughters[2 * k], daughters[2 * k + 1]}, report.divisions[k]);
    if (!settled.ok)
      report.events.push_back({EventKind::kSettlingFailed, daughters, settled.cause});
  }
  size_workspace(world, work);
  return report;
}

}  // namespace

LifeReport live(World& world, Workspace& work) {
  Clock& clock = world.state.clock;
  LifeReport report;
  if (clock.due == EventsDue::kNone || clock.due == EventsDue::kAll) {
    report = turn_over(world, work);
    clock.due = EventsDue::kAll;
    if (report.interrupted) return report;
  }
  const bool past_sleep = clock.due == EventsDue::kMeshes || clock.due == EventsDue::kZoom;
  if (!past_sleep && !update_sleep(world, work)) {
    clock.due = EventsDue::kSleep;
    report.interrupted = true;
    return report;
  }
  if (clock.due != EventsDue::kMeshes) {
    const ZoomReport zoom = update_zoom(world, work);
    if (zoom.interrupted) {
      clock.due = EventsDue::kZoom;
      report.interrupted = true;
      return report;
    }
    for (const ModelChange& c : zoom.changes)
      report.events.push_back({c.kind, {c.cell}, c.message});
  }
  mend_meshes(world, work, report);
  clock.due = report.interrupted ? EventsDue::kMeshes : EventsDue::kNone;
  return report;
}

LifeReport remove_dying(World& world, Workspace& work, std::span<const std::int64_t> cells,
                        const std::string& why) {
  LifeReport report;
  State& s = world.state;
  if (s.cycle.empty()) return report;
  std::vector<Cell> named;
  for_each_cell(s, [&](const Cell& c) {
    if (std::ranges::find(cells, lineage_of(s, c)) != cells.end()) named.push_back(c);
  });
  bring_points(world.ranks, spheres_of(named), s);
  std::vector<std::uint8_t> gone(s.cycle.size(), 0);
  for (const Cell& c : named) {
    const std::int64_t id = lineage_of(s, c);
    if (s.cycle[c.index].fate != Fate::kLyse) continue;
    gone[c.index] = 1;
    ++s.deaths;
    report.events.push_back({EventKind::kDeathEarly, {id}, "removed before it had shrunk: " + why});
    report.events.push_back({EventKind::kDeath, {id}, "removed"});
  }
  if (report.events.empty()) return report;
  exchange_cells(world.ranks, gone, {}, {}, s);
  size_workspace(world, work);
  return report;
}

double time_to_event(const World& world) {
  return std::min(
      {time_to_life_event(world), time_to_sleep_event(world), time_to_zoom_event(world)});
}

}  // namespace acinus::coupling
