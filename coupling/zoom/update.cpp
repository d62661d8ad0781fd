#include "coupling/zoom/update.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/numbers/time_grid.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/migration/fading.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/step/near_cells.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/population.hpp"
#include "coupling/subworld/settle.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/zoom/pair_forces.hpp"
#include "coupling/zoom/promote.hpp"
#include "coupling/zoom/regions.hpp"

namespace acinus::coupling {
namespace {

/// Longest step after a change of model, s: neighbours adapt to the new shape at once.
constexpr double kStepAfterChange = 5;

/// Newton steps of new meshes and of the neighbours of new spheres, s: so long that meshes are near
/// rest and a cell that goes there and back hardly wanders, so short that few are carried along.
constexpr double kSettlingStep = 300;

/// Cell to change its model, with its distance outside the zoom.
struct Candidate {
  Cell cell;
  std::int64_t lineage = 0;
  double distance = 0;  ///< um
};

struct Switches {
  std::vector<Candidate> promote, demote;
};

bool is_due(const State& s, const ZoomParams& zoom) {
  if (!zoom.moves() || s.clock.phase != Phase::kRun || !(s.clock.last_step > 0)) return false;
  return crosses_grid(time_of(s) - s.clock.last_step, time_of(s), zoom.grid);
}

/// True if the state of a cell can be converted to the other model.
bool may_change(const World& world, const Cell& c) {
  const State& s = world.state;
  const double now = s.clock.time;
  if (!s.model_since.empty() && now < s.model_since[c.index] + world.params.zoom.stay) return false;
  const Cycle* cycle = s.cycle.empty() ? nullptr : &s.cycle[c.index];
  if (cycle && cycle->fate == Fate::kLyse) return false;
  if (!c.deformable) return s.cbm.strength[c.at].at(now) >= 1;
  return !cycle || cycle->parent < 0 || now >= cycle->birth + cycle_of(world.params, s, c).mitosis;
}

/// Contact pressure of every cell, [dcm lanes, then cbm cells] kPa.
std::vector<double> observe_pressures(const World& world, Workspace& work) {
  observe(world, work);
  const State& s = world.state;
  std::vector<double> pressure(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
  const std::vector<CellMeasure> measures = measure_cells(world, work);
  const std::size_t n_body = work.dcm.lane_of_body.size();
  for (std::size_t k = 0; k < measures.size(); ++k)
    pressure[k < n_body ? work.dcm.lane_of_body[k] : s.dcm.n_lane() + k - n_body] =
        measures[k].pressure;
  return pressure;
}

/// Keeps the first n candidates of an order, sorted by lineage: results must not depend on storage
/// order.
template <class Before>
void keep_first(std::vector<Candidate>& list, std::size_t n, Before before) {
  std::ranges::sort(list, [&](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? before(a.distance, b.distance) : a.lineage < b.lineage;
  });
  if (list.size() > n) list.resize(n);
  std::ranges::sort(list, {}, &Candidate::lineage);
}

/// Cells as seen by regions, in the order of for_each_cell.
std::vector<ZoomCell> list_zoom_cells(const State& s, const std::vector<double>& pressure) {
  std::vector<ZoomCell> cells;
  for_each_cell(s, [&](const Cell& c) {
    ZoomCell z;
    z.center = center_of(s, c);
    z.radius = sphere_radius(volume_of(s, c).at(s.clock.time));
    z.lineage = lineage_of(s, c);
    if (!s.cycle.empty()) z.founder = s.cycle[c.index].founder;
    if (!pressure.empty()) z.pressure = pressure[c.index];
    cells.push_back(z);
  });
  return cells;
}

Switches find_candidates(const World& world, const std::vector<double>& pressure) {
  const State& s = world.state;
  const ZoomParams& zoom = world.params.zoom;
  const std::vector<double> distance = distances_from_zoom(
      zoom, world.params.boundary.vessels.network, list_zoom_cells(s, pressure));
  Switches found;
  std::size_t n_deformable = 0, n_cell = 0;
  for_each_cell(s, [&](const Cell& c) {
    n_deformable += c.deformable ? 1 : 0;
    const Candidate candidate{c, lineage_of(s, c), distance[n_cell++]};
    if (!c.deformable && candidate.distance <= 0 && may_change(world, c))
      found.promote.push_back(candidate);
    if (c.deformable && candidate.distance > zoom.margin && may_change(world, c))
      found.demote.push_back(candidate);
  });
  const auto at_once = static_cast<std::size_t>(zoom.at_once);
  keep_first(found.demote, at_once, std::greater{});
  std::size_t allowed = at_once - found.demote.size();
  if (zoom.most_deformable > 0) {
    const auto most = static_cast<std::size_t>(zoom.most_deformable);
    const std::size_t left = n_deformable - found.demote.size();
    allowed = std::min(allowed, most > left ? most - left : 0);
  }
  keep_first(found.promote, allowed, std::less{});
  return found;
}

/// Replaces changed cells by their new states and records the time.
void exchange(const std::vector<std::uint8_t>& gone, const std::vector<State>& fresh,
              World& world) {
  State& s = world.state;
  const bool lives = !s.cycle.empty();
  std::set<std::int64_t> changed;
  for_each_cell(s, [&](const Cell& c) {
    if (gone[c.index] != 0) changed.insert(lineage_of(s, c));
  });
  exchange_cells(world.ranks, gone, {}, fresh, s);
  if (!lives) s.cycle.clear();
  s.model_since.resize(s.dcm.n_lane() + s.cbm.n_cell(), s.clock.origin);
  for_each_cell(s, [&](const Cell& c) {
    if (changed.contains(lineage_of(s, c))) s.model_since[c.index] = s.clock.time;
  });
}

std::vector<NewShell> shape_spheres(const World& world, const std::vector<Candidate>& promote,
                                    const std::map<std::int64_t, double>& pressure) {
  std::vector<NewShell> shells(promote.size());
  const std::vector<double> radius = cbm::radii_at(world.state.cbm, world.state.clock.time);
  for_each_part(promote.size(), [&](std::size_t k) {
    const Candidate& c = promote[k];
    shells[k] = shape_sphere(world, c.cell.at, pressure.at(c.lineage), radius);
  });
  return shells;
}

/// Deformable neighbours of new spheres.
std::vector<std::int64_t> neighbours_of(const State& s, const std::vector<Candidate>& demoted,
                                        const PairForces& before) {
  std::set<std::int64_t> spheres, touched;
  for (const Candidate& c : demoted) spheres.insert(c.lineage);
  for (const auto& [pair, force] : before)
    if (spheres.contains(pair.first) || spheres.contains(pair.second))
      touched.insert({pair.first, pair.second});
  touched.erase(kNoPartner);  // boundary, whose number is that of empty lanes
  std::vector<std::int64_t> meshes;
  for (const std::int64_t lineage : s.dcm.lineage)
    if (touched.contains(lineage)) meshes.push_back(lineage);
  return meshes;
}

/// Those of the promoted cells that are deformable now.
std::vector<std::int64_t> new_meshes(const State& s, const std::vector<Candidate>& promoted) {
  std::vector<std::int64_t> meshes;
  for (const Candidate& c : promoted)
    if (std::ranges::find(s.dcm.lineage, c.lineage) != s.dcm.lineage.end())
      meshes.push_back(c.lineage);
  return meshes;
}

/// Settles meshes; new ones return to their places.
/// @return false if the process was asked to stop
bool settle(World& world, const std::vector<std::int64_t>& meshes, bool are_new,
            ZoomReport& report) {
  if (meshes.empty()) return true;
  const Settled settled = settle_cells(world, meshes, kSettlingStep, are_new);
  if (settled.ok) return true;
  if (stop_requested()) return false;
  for (const std::int64_t cell : meshes)
    report.changes.push_back({EventKind::kSettlingFailed, cell, settled.cause});
  return true;
}

/// Changes the models of the candidates; cells without an acceptable shape keep theirs.
void change_models(World& world, const Switches& all,
                   const std::map<std::int64_t, double>& pressure, ZoomReport& report) {
  State& s = world.state;
  const std::vector<NewShell> shells = shape_spheres(world, all.promote, pressure);
  std::vector<std::uint8_t> gone(s.dcm.n_lane() + s.cbm.n_cell(), 0);
  std::vector<State> fresh;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const Candidate& c = all.promote[k];
    if (!shells[k].ok) {
      report.changes.push_back({EventKind::kPromotionWaits, c.lineage, shells[k].why});
      continue;
    }
    gone[c.cell.index] = 1;
    fresh.push_back(make_shell(world, c.cell.at, shells[k]));
    report.changes.push_back({EventKind::kPromotion, c.lineage,
                              fmt::format("becomes deformable at a pressure of {:.3g} Pa",
                                          1e3 * pressure.at(c.lineage))});
  }
  for (const Candidate& c : all.demote) {
    gone[c.cell.index] = 1;
    fresh.push_back(make_sphere(world, c.cell.at));
    report.changes.push_back(
        {EventKind::kDemotion, c.lineage,
         fmt::format("becomes a sphere at a pressure of {:.3g} Pa", 1e3 * pressure.at(c.lineage))});
  }
  if (!fresh.empty()) exchange(gone, fresh, world);
}

}  // namespace

double time_to_zoom_event(const World& world) {
  const ZoomParams& zoom = world.params.zoom;
  if (!zoom.moves()) return std::numeric_limits<double>::infinity();
  return time_to_next_interval(time_of(world.state), zoom.grid);
}

ZoomReport update_zoom(World& world, Workspace& work) {
  ZoomReport report;
  State& s = world.state;
  if (!is_due(s, world.params.zoom)) return report;
  const auto scope = work.timings.scope("zoom");
  complete_points(world, work);
  forget_faded(s);
  std::vector<double> pressure;
  if (zoom_needs_pressure(world.params.zoom)) pressure = observe_pressures(world, work);
  const Switches all = find_candidates(world, pressure);
  if (all.promote.empty() && all.demote.empty()) return report;
  std::set<std::int64_t> changing;
  for (const auto* list : {&all.promote, &all.demote})
    for (const Candidate& c : *list) changing.insert(c.lineage);
  complete_contacts(world.ranks, s);
  complete_cells(world.ranks, s);
  const CellContacts before = evaluate_contacts(world, changing);
  State old = s;
  change_models(world, all, before.pressure, report);
  if (!settle(world, neighbours_of(s, all.demote, before.pair), false, report) ||
      !settle(world, new_meshes(s, all.promote), true, report)) {
    s = std::move(old);
    return {{}, true};
  }
  const PairForces after = evaluate_contacts(world, changing).pair;
  size_workspace(world, work);
  s.clock.step = std::min(s.clock.step, kStepAfterChange);
  keep_fading(old, s);
  add_fading(world, before.pair, after, s.fading);
  return report;
}

}  // namespace acinus::coupling
