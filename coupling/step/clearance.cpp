#include "coupling/step/clearance.hpp"

#include <algorithm>

#include "core/parallel/threads.hpp"
#include "coupling/step/lane_box.hpp"
#include "dcm/contact/contact.hpp"

namespace acinus::coupling {
namespace {

/// Box that others must not reach, with the cell that asks.
LaneBox make_claim(const World& world, const Workspace& w, const MovedCell& cell) {
  const auto at = std::ranges::lower_bound(w.dcm.lane_of_body, cell.lane);
  const contact::SurfaceBody& b = w.dcm.body[at - w.dcm.lane_of_body.begin()];
  const double range =
      dcm::contact_range(world.params.dcm_contact, *b.topology, w.lanes.radius[cell.lane]);
  return pack_box(cell.lane, b.box.grown(2 * cell.distance + range));
}

/// True if a cell of this process is in the box of another.
bool has_own_cell(const World& world, const Workspace& w, const LaneBox& claim) {
  const State& s = world.state;
  const Box box = box_of(claim);
  for (std::size_t k = 0; k < w.dcm.body.size(); ++k) {
    const std::size_t lane = w.dcm.lane_of_body[k];
    if (lane != lane_of(claim) && !w.dcm.is_ghost(lane) && box.overlaps(w.dcm.body[k].box))
      return true;
  }
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    if (!w.cbm.is_ghost(c) && box.overlaps(sphere_box(cbm::center_of(s.cbm, c), w.cbm_radius[c])))
      return true;
  return false;
}

bool has_boundary(const World& world, const Box& box) {
  const contact::Boundary& boundary = world.params.boundary;
  // Vessels and meshes are not tested one by one: cells near them keep the displacement limit.
  if (!boundary.meshes.empty() || !boundary.vessels.network.segment.empty()) return true;
  bool found = false;
  const Clock& clock = world.state.clock;
  const double time = wall_time(clock, clock.time);
  const double reach = 0.5 * (box.high - box.low).norm();
  contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
    const Vec3 middle = 0.5 * (box.low + box.high);
    found = found || !(contact::gap_to_wall(wall, middle, time).gap > reach);
  });
  return found;
}

}  // namespace

std::vector<std::uint8_t> find_clear(const World& world, const Workspace& w,
                                     std::span<const MovedCell> cells) {
  const solve::Ownership& ownership = w.system.ownership;
  std::vector<LaneBox> own, all;
  for (const MovedCell& c : cells) own.push_back(make_claim(world, w, c));
  std::vector<std::size_t> start{0, own.size()};
  if (ownership.is_whole())
    all = own;
  else
    ownership.ranks.gather<LaneBox>(own, all, &start);
  std::vector<double> taken(all.size(), 0.0);
  for_each_index(all.size(), worth_threads(w.system.n_row),
                 [&](std::size_t k) { taken[k] = has_own_cell(world, w, all[k]) ? 1 : 0; });
  const std::size_t first =
      ownership.is_whole() ? 0 : start[static_cast<std::size_t>(ownership.ranks.rank())];
  if (!ownership.is_whole()) ownership.ranks.max(taken);
  std::vector<std::uint8_t> clear;
  for (std::size_t k = 0; k < own.size(); ++k)
    clear.push_back(taken[first + k] == 0 && !has_boundary(world, box_of(own[k])) ? 1 : 0);
  return clear;
}

}  // namespace acinus::coupling
