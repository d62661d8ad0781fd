#include "coupling/step/near_cells.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "cbm/contact.hpp"
#include "core/sphere.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/lane_box.hpp"
#include "coupling/step/move_points.hpp"
#include "dcm/contact/contact.hpp"
#include "geometry/box_pairs.hpp"

namespace acinus::coupling {
namespace {

/// Distance, um, that a cell may move or grow before near cells are found anew.
constexpr double kRoom = 1;

/// True if a part of the model reads the points of all cells in a step, or every process keeps all
/// of all cells.
bool reads_all_points(const World& world) {
  const Params& p = world.params;
  const State& s = world.state;
  return s.cell_holder.empty() || s.clock.phase != Phase::kRun ||
         p.numerics.integrator == Integrator::kNewton || p.motility.leader_force > 0 ||
         p.dcm_contact.law == dcm::ContactLaw::kMaugisDugdale || p.sleep.enabled ||
         p.substances.exists() || !p.rules.rule.empty() || !s.fading.empty() ||
         std::ranges::any_of(p.dcm, [](const dcm::Params& t) { return t.series_friction > 0; });
}

/// Cell of this process with the box around its points, now and after a step like the last one.
struct OwnCell {
  std::size_t lane = 0;
  Box box;
};

/// Own cells, and what all processes must know of the largest of them.
struct OwnCells {
  std::vector<OwnCell> cell;
  double range = 0;  ///< um, of contacts of surfaces
  cbm::Extremes spheres;
};

void include_point(const State& s, std::size_t k, bool moves, Box& box) {
  const double* const at = position_of(s, static_cast<Address>(k));
  const Vec3 x = load_point(at, 0);
  box.include(x);
  if (moves) box.include(x + load_point(s.last_move.data(), static_cast<Address>(k)));
}

OwnCells list_own_cells(const World& world) {
  const State& s = world.state;
  const double t = s.clock.time;
  const bool moves = world.params.numerics.extrapolate && has_last_move(s);
  OwnCells own;
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane) {
    if (s.cell_holder[lane] != world.ranks.rank() || !s.dcm.active(lane)) continue;
    const dcm::Group& group = s.dcm.group[lane / kLanes];
    OwnCell c{lane, {}};
    for (int i = 0; i < group.n_point(); ++i)
      include_point(s, dcm::node_address(s.dcm, lane, i), moves, c.box);
    own.cell.push_back(c);
    own.range = std::max(own.range, dcm::contact_range(world.params.dcm_contact, *group.topology,
                                                       sphere_radius(s.dcm.volume[lane].at(t))));
  }
  for (std::size_t k = 0; k < s.cbm.n_cell(); ++k) {
    const std::size_t lane = s.dcm.n_lane() + k;
    if (s.cell_holder[lane] != world.ranks.rank()) continue;
    const double radius = sphere_radius(s.cbm.volume[k].at(t));
    OwnCell c{lane, {}};
    include_point(s, cbm::cell_address(s.dcm.n_row(), k), moves, c.box);
    c.box = c.box.grown(radius);
    own.cell.push_back(c);
    own.spheres.largest = std::max(own.spheres.largest, radius);
    own.spheres.softest = std::min(own.spheres.softest, s.cbm.young[k]);
  }
  return own;
}

FloatBox rounded(const Box& b) { return {b.low.cast<float>(), b.high.cast<float>()}; }

/// Farthest that a box has come out of another, um.
double farthest_out(const Box& now, const FloatBox& before) {
  return std::max((before.low.cast<double>() - now.low).maxCoeff(),
                  (now.high - before.high.cast<double>()).maxCoeff());
}

/// Farthest that own cells have come out of their boxes; infinite if these are of other cells.
double measure_motion(const OwnCells& own, const NearCells& near) {
  if (own.cell.size() != near.box.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t k = 0; k < own.cell.size(); ++k)
    most = std::max(most, farthest_out(own.cell[k].box, near.box[k]));
  return most;
}

/// Gap of boxes, um, beyond which two cells of any processes cannot touch in this step.
double compute_reach(const Params& p, double range, const cbm::Extremes& spheres) {
  const double shells = std::max(range, p.dcm_contact.max_depth) + p.dcm_contact.skin;
  return std::max(shells, cbm::largest_separation(p.cbm, spheres, p.boundary) + p.cbm_contact.skin);
}

std::vector<Box> boxes_of(std::span<const LaneBox> cells) {
  std::vector<Box> boxes;
  for (const LaneBox& c : cells) boxes.push_back(box_of(c));
  return boxes;
}

/// Boxes around the cells of each process.
std::vector<Box> gather_domains(const Ranks& ranks, const OwnCells& own) {
  Box whole;
  for (const OwnCell& c : own.cell) {
    whole.include(c.box.low);
    whole.include(c.box.high);
  }
  const LaneBox sent = pack_box(0, whole);
  std::vector<LaneBox> all;
  ranks.gather<LaneBox>(std::span(&sent, 1), all);
  return boxes_of(all);
}

/// Cells that this process and its peers have near each other's domains, run by run of `plan`.
struct BorderCells {
  ExchangePlan plan;
  std::vector<LaneBox> own, other;
};

BorderCells exchange_border_cells(const Ranks& ranks, const OwnCells& own, double reach) {
  const std::vector<Box> domain = gather_domains(ranks, own);
  const auto self = static_cast<std::size_t>(ranks.rank());
  BorderCells border;
  for (std::size_t rank = 0; rank < domain.size(); ++rank) {
    const auto& [low, high] = std::minmax(rank, self);  // both sides compare the same numbers
    if (rank == self || !domain[low].grown(reach).overlaps(domain[high])) continue;
    const Box within = domain[rank].grown(reach);
    const std::size_t first = border.own.size();
    for (const OwnCell& c : own.cell)
      if (within.overlaps(c.box)) border.own.push_back(pack_box(c.lane, c.box));
    border.plan.peer.push_back({static_cast<int>(rank), first, border.own.size(), 0, 0});
  }
  border.other.resize(exchange_lengths(ranks, border.plan));
  ranks.exchange<LaneBox>(border.plan, border.own, border.other);
  return border;
}

/// Appends the lanes of the marked cells.
void append_marked(std::span<const LaneBox> cells, const std::vector<std::uint8_t>& marked,
                   std::vector<std::size_t>& lanes) {
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (marked[k] != 0) lanes.push_back(lane_of(cells[k]));
}

/// Finds the cells of each pair of processes that are closer than `reach`, alike on both.
NearCells find_near_cells(const World& world, const OwnCells& own, double reach) {
  const BorderCells border = exchange_border_cells(world.ranks, own, reach);
  NearCells near;
  for (const ExchangePlan::Peer& p : border.plan.peer) {
    const auto mine = std::span(border.own).subspan(p.send_begin, p.send_end - p.send_begin);
    const auto theirs =
        std::span(border.other).subspan(p.receive_begin, p.receive_end - p.receive_begin);
    const bool first = world.ranks.rank() < p.rank;
    std::vector<std::uint8_t> sends(mine.size(), 0), receives(theirs.size(), 0);
    std::vector<Box> a = boxes_of(first ? mine : theirs), b = boxes_of(first ? theirs : mine);
    for (const auto& [i, j] : geometry::find_pairs_between(a, b, reach)) {
      sends[static_cast<std::size_t>(first ? i : j)] = 1;
      receives[static_cast<std::size_t>(first ? j : i)] = 1;
    }
    ExchangePlan::Peer lanes{p.rank, near.send.size(), 0, near.receive.size(), 0};
    append_marked(mine, sends, near.send);
    append_marked(theirs, receives, near.receive);
    lanes.send_end = near.send.size();
    lanes.receive_end = near.receive.size();
    if (lanes.send_end > lanes.send_begin || lanes.receive_end > lanes.receive_begin)
      near.plan.peer.push_back(lanes);
  }
  return near;
}

/// Sends numbers of own cells that others are near.
/// @param count  count(lane) of a cell
/// @param pack   pack(lane, numbers): appends them
/// @param unpack unpack(lane, first number): reads them, and returns their end
template <class Count, class Pack, class Unpack>
void exchange_near(const Ranks& ranks, const NearCells& near, const Count& count, const Pack& pack,
                   const Unpack& unpack) {
  ExchangePlan plan;
  std::vector<double> out;
  std::size_t n_in = 0;
  for (const ExchangePlan::Peer& p : near.plan.peer) {
    plan.peer.push_back({p.rank, out.size(), 0, n_in, 0});
    for (std::size_t k = p.send_begin; k < p.send_end; ++k) pack(near.send[k], out);
    for (std::size_t k = p.receive_begin; k < p.receive_end; ++k) n_in += count(near.receive[k]);
    plan.peer.back().send_end = out.size();
    plan.peer.back().receive_end = n_in;
  }
  std::vector<double> in(n_in);
  ranks.exchange<double>(plan, out, in);
  const double* from = in.data();
  for (const std::size_t lane : near.receive) from = unpack(lane, from);
}

/// Marks the cells without points for the contact search, which forgets its lists.
void mark_absent_cells(Workspace& w, const State& s) {
  const auto mark = [&](std::vector<std::uint8_t>& ghost, std::size_t first, std::uint8_t absent) {
    for (std::size_t k = 0; k < ghost.size(); ++k)
      if (ghost[k] != 0) ghost[k] = std::ranges::binary_search(s.near, first + k) ? 1 : absent;
  };
  mark(w.dcm.ghost, 0, dcm::ContactWorkspace::kAbsent);
  mark(w.cbm.ghost, s.dcm.n_lane(), cbm::ContactWorkspace::kAbsent);
  w.dcm.lane_of_body.clear();
  w.cbm.list_position.clear();
}

/// Makes ghost cells of those without points.
void unmark_absent_cells(Workspace& w) {
  std::ranges::replace(w.dcm.ghost, dcm::ContactWorkspace::kAbsent, std::uint8_t{1});
  std::ranges::replace(w.cbm.ghost, cbm::ContactWorkspace::kAbsent, cbm::ContactWorkspace::kFar);
  w.dcm.lane_of_body.clear();
}

}  // namespace

void refresh_near_cells(World& world, Workspace& w) {
  State& s = world.state;
  if (reads_all_points(world)) return complete_points(world, w);
  NearCells& near = w.near;
  if (s.near_set != near.set && s.near_set != kOwnPoints)
    complete_points(world, w);  // another state has come
  const OwnCells own = list_own_cells(world);
  const bool known = s.near_set > 0;
  std::array<double, 4> most{known ? measure_motion(own, near) : 0, own.range, -own.spheres.softest,
                             own.spheres.largest};
  world.ranks.max(most);
  const double reach = compute_reach(world.params, most[1], {-most[2], most[3]});
  if (known && most[0] <= kRoom && reach <= near.reach + kRoom) return;
  // Two cells may both move, and their reach grow; a fourth part is for growth within a step, and
  // for rounding.
  NearCells next = find_near_cells(world, own, reach + 4 * kRoom);
  if (s.near_set != 0)
    exchange_near(
        world.ranks, next, [&](std::size_t lane) { return count_near_numbers(s, lane); },
        [&](std::size_t lane, std::vector<double>& out) { pack_near(s, lane, out); },
        [&](std::size_t lane, const double* from) { return unpack_near(from, lane, s); });
  next.reach = reach;
  next.set = ++w.near_sets;
  for (const OwnCell& c : own.cell) next.box.push_back(rounded(c.box));
  near = std::move(next);
  s.near_set = near.set;
  s.near = near.receive;
  std::ranges::sort(s.near);
  drop_far(world.ranks, s, world.sharing == Sharing::kRandom);
  w.linearisation.state = {};
  mark_absent_cells(w, s);
}

void complete_points(World& world, Workspace& w) {
  if (world.state.near_set == 0) return;
  complete_near(world.ranks, world.state);
  w.near.set = 0;
  unmark_absent_cells(w);
}

void move_present_points(const Workspace& w, std::span<const double> by, State& s) {
  if (s.near_set == 0)
    return solve::stream_rows(w.system, by, [&](std::size_t first, std::span<const double> rows) {
      move_points(s, first, rows);
    });
  for_each_own_number(w.system, [&](std::size_t k) { number_of(s, k) += by[k]; });
  exchange_near(
      w.system.ownership.ranks, w.near,
      [&](std::size_t lane) { return 3 * static_cast<std::size_t>(points_of(s, lane)); },
      [&](std::size_t lane, std::vector<double>& out) {
        for_each_number_of(s, lane, [&](std::size_t k) { out.push_back(by[k]); });
      },
      [&](std::size_t lane, const double* from) {
        for_each_number_of(s, lane, [&](std::size_t k) { number_of(s, k) += *from++; });
        return from;
      });
}

}  // namespace acinus::coupling
