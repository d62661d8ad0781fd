#include "runs/session/soundness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/sphere.hpp"
#include "coupling/measure/nuclei.hpp"
#include "coupling/world/cell.hpp"
#include "runs/session/together.hpp"

namespace acinus::runs {
namespace {

/// Radius of a sphere, from the process that has it, um.
double radius_of(const coupling::World& world, const coupling::Workspace& work, std::int64_t id) {
  const coupling::State& s = world.state;
  const std::size_t k = coupling::find_cell(s, id).value().at;
  const double own = work.cbm.is_ghost(k) ? 0 : sphere_radius(s.cbm.volume[k].at(s.clock.time));
  return world.ranks.max(own);
}

/// Worst finding of all processes about their own cells.
/// @param place  of `own` in the order of one process; of equal depths the first counts
Excess worst_of_all(const Ranks& ranks, const Excess& own, std::size_t place) {
  struct Claim {
    double depth = 0;
    std::size_t place = 0;
  };
  const Claim claim{own.depth_um, place};
  std::vector<Claim> all;
  ranks.gather<Claim>(std::span(&claim, 1), all);
  std::size_t worst = 0;
  for (std::size_t r = 1; r < all.size(); ++r)
    if (all[r].depth > all[worst].depth ||
        (all[r].depth == all[worst].depth && all[r].place < all[worst].place))
      worst = r;
  if (!(all[worst].depth > 0)) return {};
  const bool is_mine = worst == static_cast<std::size_t>(ranks.rank());
  Excess found{all[worst].depth, first_text(ranks, is_mine ? own.cause : std::string()), {}};
  ranks.gather<std::int64_t>(is_mine ? std::span(own.cells) : std::span<const std::int64_t>(),
                             found.cells);
  return found;
}

/// Sphere whose centre lies deepest inside an obstacle; depth_um = 0 if there is none.
Excess find_lost_sphere(const coupling::AuditResult& audit, const coupling::World& world,
                        const coupling::Workspace& work) {
  const cbm::State& s = world.state.cbm;
  const contact::Boundary& boundary = world.params.boundary;
  const double time = std::max(0.0, coupling::time_since_start(world));
  Excess worst;
  std::size_t place = 0;  // walls come before vessels
  const auto look = [&](std::size_t k, std::size_t at, const contact::Gap& gap, const auto& name) {
    if (-gap.gap <= worst.depth_um) return;
    place = at;
    worst = {-gap.gap,
             fmt::format("CBM cell {} has its centre {:.3g} um inside {}", s.lineage[k], -gap.gap,
                         name()),
             {s.lineage[k]}};
  };
  for (std::size_t k = 0; k < s.n_cell(); ++k) {
    if (work.cbm.is_ghost(k)) continue;  // audited by its owner
    const Vec3 x = cbm::center_of(s, k);
    contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
      look(k, k, contact::gap_to_wall(wall, x, time), [&] { return contact::wall_label(wall); });
    });
  }
  for (const auto& [cell, segment] : work.cbm.segment) {
    const std::size_t k = cell;
    if (work.cbm.is_ghost(k)) continue;
    look(k, s.n_cell() + k,
         contact::gap_to_segment(boundary.vessels.network, segment, cbm::center_of(s, k)),
         [&, at = segment] { return fmt::format("vessel segment {}", at); });
  }
  if (!work.system.ownership.is_whole()) worst = worst_of_all(world.ranks, worst, place);
  // Contact sees meshes from near only, and not which side is which from far inside: the audit
  // does.
  if (const coupling::WorstPair& lost = audit.center_in_static; lost.depth_um > worst.depth_um) {
    const contact::StaticMesh& mesh = boundary.meshes[lost.ids[1]];
    worst = {lost.depth_um,
             fmt::format("CBM cell {} has its centre {:.3g} um {} static mesh {}", lost.ids[0],
                         lost.depth_um, mesh.inside ? "outside" : "inside", mesh.name),
             {lost.ids[0]}};
  }
  return worst;
}

/// Nucleus that protrudes farthest from its cortex. Contact searches max_depth deep for it, so that
/// half of that is still safe.
Excess find_leak(const coupling::World& world, const coupling::Workspace& work) {
  const coupling::NucleusLeak leak = coupling::measure_nucleus_leak(world.state, work.dcm.ghost);
  const double limit = 0.5 * world.params.dcm_contact.max_depth;
  if (!(leak.depth_um > limit)) return {};
  return {leak.depth_um - limit,
          fmt::format("the nucleus of DCM cell {} stands {:.3g} um outside its cortex, beyond the "
                      "{:.3g} um that contact mends",
                      leak.cell, leak.depth_um, limit),
          {leak.cell}};
}

Excess find_leak_of_all(const coupling::World& world, const coupling::Workspace& work) {
  const Excess own = find_leak(world, work);
  if (work.system.ownership.is_whole() || !dcm::has_nuclei(world.state.dcm)) return own;
  const std::size_t place =
      own.cells.empty() ? 0 : coupling::find_cell(world.state, own.cells.front()).value().at;
  return worst_of_all(world.ranks, own, place);
}

}  // namespace

double deepest_overlap(const coupling::World& world) {
  const dcm::State& s = world.state.dcm;
  double edge = 0;
  for (std::size_t l = 0; l < s.n_lane(); ++l)
    if (s.active(l))
      edge = std::max(edge, s.group[l / kLanes].topology->mean_rest_length *
                                sphere_radius(s.volume[l].at(world.state.clock.time)));
  return world.params.dcm_contact.max_depth + kOverlapBetweenPoints * edge;
}

Excess find_excess(const coupling::AuditResult& audit, const coupling::World& world,
                   const coupling::Workspace& work) {
  Excess worst = find_lost_sphere(audit, world, work);
  if (Excess leak = find_leak_of_all(world, work); leak.depth_um > worst.depth_um)
    worst = std::move(leak);
  const auto look = [&](const coupling::WorstPair& pair, double limit, const char* what,
                        std::size_t n_cell) {
    if (pair.depth_um - limit <= worst.depth_um) return;
    worst.depth_um = pair.depth_um - limit;
    worst.cells.assign(pair.ids.begin(), pair.ids.begin() + static_cast<std::ptrdiff_t>(n_cell));
    worst.cause = fmt::format("{} {} overlap by {:.3g} um, beyond the {:.3g} um that contact mends",
                              what, fmt::join(pair.ids, " and "), pair.depth_um, limit);
  };
  const double limit = deepest_overlap(world);
  look(audit.dcm_dcm, limit, "DCM cells", 2);
  look(audit.dcm_wall, limit, "DCM cell and wall", 1);
  look(audit.dcm_vessel, limit, "DCM cell and vessel segment", 1);
  if (!audit.dcm_cbm.ids.empty())
    look(audit.dcm_cbm, radius_of(world, work, audit.dcm_cbm.ids[1]), "DCM cell and CBM cell", 2);
  if (!audit.cbm_cbm.ids.empty())
    look(audit.cbm_cbm,
         std::max(radius_of(world, work, audit.cbm_cbm.ids[0]),
                  radius_of(world, work, audit.cbm_cbm.ids[1])),
         "CBM cells", 2);
  if (audit.n_inverted > 0)
    worst = {std::numeric_limits<double>::infinity(),
             fmt::format("{} cells are inside out", audit.n_inverted),
             {}};
  return worst;
}

}  // namespace acinus::runs
