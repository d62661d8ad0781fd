#include "coupling/step/clearance.hpp"

#include <algorithm>
#include <array>

#include "core/parallel/threads.hpp"
#include "dcm/contact/contact.hpp"

namespace acinus::coupling {
namespace {

/// Box that others must not reach, and the lane of the cell that asks.
using Claim = std::array<double, 7>;

Box claimed_box(const Claim& c) { return {{c[1], c[2], c[3]}, {c[4], c[5], c[6]}}; }

Claim make_claim(const World& world, const Workspace& w, const MovedCell& cell) {
  const auto at = std::ranges::lower_bound(w.dcm.lane_of_body, cell.lane);
  const contact::SurfaceBody& b = w.dcm.body[at - w.dcm.lane_of_body.begin()];
  const double range =
      dcm::contact_range(world.params.dcm_contact, *b.topology, w.lanes.radius[cell.lane]);
  const Box box = b.box.grown(2 * cell.distance + range);
  return {static_cast<double>(cell.lane),
          box.low[0],
          box.low[1],
          box.low[2],
          box.high[0],
          box.high[1],
          box.high[2]};
}

/// True if a cell of this process is in the box of another.
bool has_own_cell(const World& world, const Workspace& w, const Claim& claim) {
  const State& s = world.state;
  const auto asks = static_cast<std::size_t>(claim[0]);
  const Box box = claimed_box(claim);
  for (std::size_t k = 0; k < w.dcm.body.size(); ++k) {
    const std::size_t lane = w.dcm.lane_of_body[k];
    if (lane != asks && !w.dcm.is_ghost(lane) && box.overlaps(w.dcm.body[k].box)) return true;
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
  const double reach = 0.5 * (box.high - box.low).norm();
  contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
    const Vec3 middle = 0.5 * (box.low + box.high);
    found = found || !(contact::gap_to_wall(wall, middle, world.state.clock.time).gap > reach);
  });
  return found;
}

}  // namespace

std::vector<std::uint8_t> find_clear(const World& world, const Workspace& w,
                                     std::span<const MovedCell> cells) {
  const solve::Ownership& ownership = w.system.ownership;
  std::vector<Claim> own, all;
  for (const MovedCell& c : cells) own.push_back(make_claim(world, w, c));
  std::vector<std::size_t> start{0, own.size()};
  if (ownership.is_whole())
    all = own;
  else
    ownership.ranks.gather<Claim>(own, all, &start);
  std::vector<double> taken(all.size(), 0.0);
  for_each_index(all.size(), worth_threads(w.system.n_row),
                 [&](std::size_t k) { taken[k] = has_own_cell(world, w, all[k]) ? 1 : 0; });
  const std::size_t first =
      ownership.is_whole() ? 0 : start[static_cast<std::size_t>(ownership.ranks.rank())];
  if (!ownership.is_whole()) ownership.ranks.max(taken);
  std::vector<std::uint8_t> clear;
  for (std::size_t k = 0; k < own.size(); ++k)
    clear.push_back(taken[first + k] == 0 && !has_boundary(world, claimed_box(own[k])) ? 1 : 0);
  return clear;
}

}  // namespace acinus::coupling
