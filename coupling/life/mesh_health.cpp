#include "coupling/life/mesh_health.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "core/numbers/time_grid.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/settle.hpp"
#include "coupling/world/cell.hpp"
#include "dcm/shape/mesh_remedy.hpp"
#include "dcm/shape/place_nucleus.hpp"
#include "dcm/tensions.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

double reference_radius(const State& s, std::size_t lane) {
  return sphere_radius(s.dcm.volume[lane].at(s.clock.time));
}

const geometry::Topology& topology_of(const State& s, std::size_t lane) {
  return *s.dcm.group[lane / kLanes].topology;
}

/// Set of meshes due for a check: none, those that still relax from a given shape, or all. Depends
/// on the clock alone, so a resumed run checks at the same times.
enum class Due { kNone, kYoung, kAll };
Due find_due(const State& s, double grid) {
  if (s.clock.phase != Phase::kRun || !(s.clock.last_step > 0)) return Due::kNone;
  return crosses_grid(time_of(s) - s.clock.last_step, time_of(s), grid) ? Due::kAll : Due::kYoung;
}

/// Mean stretch of the links: total length over total rest length.
double find_link_stretch(const State& s, std::size_t lane, std::span<const double> ratio) {
  const dcm::BirthShape& b = s.dcm.birth[lane];
  const double time = s.clock.time, weight = b.is_forgotten(time) ? 0 : b.weight.at(time);
  double present = 0, rest = 0;
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    present += ratio[i];
    rest += b.link.empty() ? 1 : 1 + weight * (b.link[i] - 1);
  }
  return present / rest;
}

/// Rotates the nucleus with the new mesh of its cortex and keeps the mean stretch of its links.
/// @param old  [n_node] um, old nodes of the cortex, whose new ones are in place
/// @return rest lengths of the links for the birth shape of the cell; empty without a nucleus
std::vector<double> adapt_nucleus(const dcm::Params& params, std::size_t lane,
                                  const std::vector<Vec3>& old, const std::vector<Vec3>& node,
                                  State& s) {
  const dcm::Group& group = s.dcm.group[lane / kLanes];
  if (!group.nucleus.exists()) return {};
  const double radius = reference_radius(s, lane);
  std::vector<Vec3> before;
  dcm::copy_nucleus(s.dcm, lane, before);
  const double stretch = find_link_stretch(s, lane, dcm::link_ratios(group, radius, old, before));
  std::vector<Vec3> nucleus = dcm::turn_nucleus(group, node, before);
  if (nucleus.empty())
    nucleus = dcm::place_nucleus(group, node, group.nucleus.size * radius, params.nucleus->gap);
  dcm::store_nucleus(nucleus, lane, s.dcm);
  std::vector<double> link = dcm::link_ratios(group, radius, node, nucleus);
  for (double& l : link) l /= stretch;
  return link;
}

void replace_mesh(const dcm::Params& params, State& s, std::size_t lane,
                  const std::vector<Vec3>& node) {
  std::vector<Vec3> old;
  dcm::copy_nodes(s.dcm, lane, old);
  const double t = s.clock.time;
  const double stretch = dcm::measure_stretch(s.dcm.birth[lane], topology_of(s, lane), old,
                                              reference_radius(s, lane), t);
  std::vector<double> link = adapt_nucleus(params, lane, old, node, s);
  s.dcm.birth[lane] = dcm::make_birth_shape(topology_of(s, lane), node, reference_radius(s, lane),
                                            stretch, {1, 0, t, t + dcm::kForgetShape});
  s.dcm.birth[lane].link = std::move(link);
  dcm::EdgeTension& tension = s.dcm.tension[lane];
  if (!tension.is_new())
    tension = dcm::make_tension(topology_of(s, lane), node, dcm::mean_tension(tension));
  dcm::store_nodes(node, lane, s.dcm);
  if (has_last_move(s))
    for (int i = 0; i < s.dcm.group[lane / kLanes].n_point(); ++i)
      store_point(s.last_move.data(), dcm::node_address(s.dcm, lane, i), Vec3::Zero());
  if (!s.cell_holder.empty()) s.cell_holder.set(lane, kEverywhere);
  if (lane < s.asleep.size()) s.asleep[lane] = 0;
}

std::string describe(const dcm::Mended& m) {
  if (!m.ok)
    return fmt::format("quality {:.2g}, spacing {:.2g}, fold {:.2g}{}; {}", m.before.quality,
                       m.before.spacing, m.before.opposed, m.crossed ? ", crosses itself" : "",
                       m.why);
  return fmt::format(
      "{}: quality {:.2g} -> {:.2g}, spacing {:.2g} -> {:.2g}, fold {:.2g} -> {:.2g}{}; surface "
      "{:.2f} um out, {:.2f} um in, area {:+.2f} %",
      m.method, m.before.quality, m.after.quality, m.before.spacing, m.after.spacing,
      m.before.opposed, m.after.opposed, m.crossed ? ", had crossed itself" : "", m.shift.outside,
      m.shift.inside, 100 * m.area_change);
}

}  // namespace

namespace {

/// Lanes with a suspicious mesh among those that has(lane) accepts.
template <class Has>
std::vector<std::size_t> find_suspicious(const State& s, bool only_young, const Has& has) {
  const std::size_t n = s.dcm.n_lane();
  std::vector<std::uint8_t> suspicious(n, 0);
  for_each_index(n, worth_threads(s.dcm.n_row()), [&](std::size_t l) {
    if (!s.dcm.active(l) || !has(l)) return;
    if (only_young && s.dcm.birth[l].is_forgotten(s.clock.time)) return;
    thread_local std::vector<Vec3> node;
    dcm::copy_nodes(s.dcm, l, node);
    suspicious[l] =
        dcm::is_suspicious(dcm::measure_health(topology_of(s, l), node, reference_radius(s, l)))
            ? 1
            : 0;
  });
  std::vector<std::size_t> lanes;
  for (std::size_t l = 0; l < n; ++l)
    if (suspicious[l] != 0) lanes.push_back(l);
  return lanes;
}

/// Lanes with a suspicious mesh; each process tests the cells whose points it holds.
std::vector<std::size_t> find_all_suspicious(const World& world, bool only_young) {
  const State& s = world.state;
  if (s.near_set == 0) return find_suspicious(s, only_young);
  const auto is_own = [&](std::size_t l) { return s.cell_holder[l] == world.ranks.rank(); };
  const std::vector<std::size_t> own = find_suspicious(s, only_young, is_own);
  std::vector<std::size_t> all;
  world.ranks.gather<std::size_t>(own, all);
  std::ranges::sort(all);
  return all;
}

}  // namespace

std::vector<std::size_t> find_suspicious(const State& s, bool only_young) {
  return find_suspicious(s, only_young, [](std::size_t) { return true; });
}

void mend_meshes(World& world, Workspace& work, LifeReport& report) {
  State& s = world.state;
  if (!world.params.life.remesh) return;
  const Due due = find_due(s, world.params.life.grid);
  if (due == Due::kNone) return;
  const auto scope = work.timings.scope("mesh health");
  const std::vector<std::size_t> lanes = find_all_suspicious(world, due == Due::kYoung);
  if (lanes.empty()) return;
  bring_points(world.ranks, lanes, s);
  complete_shapes(world.ranks, lanes, s);
  State before = s;
  std::vector<dcm::Mended> mended(lanes.size());
  for_each_part(lanes.size(), [&](std::size_t k) {
    std::vector<Vec3> node;
    dcm::copy_nodes(s.dcm, lanes[k], node);
    mended[k] = dcm::mend_mesh(topology_of(s, lanes[k]), node, reference_radius(s, lanes[k]));
  });
  LifeReport mending;
  std::vector<std::int64_t> changed;
  for (std::size_t k = 0; k < lanes.size(); ++k) {
    const std::int64_t lineage = s.dcm.lineage[lanes[k]];
    if (!mended[k].ok && due == Due::kYoung) continue;  // named once a grid interval
    mending.events.push_back({mended[k].ok ? EventKind::kRemeshed : EventKind::kMeshDegenerate,
                              {lineage},
                              describe(mended[k])});
    if (!mended[k].ok) continue;
    replace_mesh(world.params.dcm[s.dcm.group[lanes[k] / kLanes].type], s, lanes[k],
                 mended[k].node);
    changed.push_back(lineage);
  }
  if (!changed.empty()) {
    const Settled settled = settle_cells(world, changed);
    if (!settled.ok && stop_requested()) {
      s = std::move(before);
      report.interrupted = true;
      return;
    }
    if (!settled.ok) mending.events.push_back({EventKind::kSettlingFailed, changed, settled.cause});
    size_workspace(world, work);
  }
  std::ranges::move(mending.events, std::back_inserter(report.events));
}

}  // namespace acinus::coupling
