#include "coupling/step/held_cells.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "coupling/step/ghost_cells.hpp"

namespace acinus::coupling {
namespace {

/// Lanes of all blocks of cells, with empty ones.
std::size_t count_lanes(const State& s) { return s.dcm.n_lane() + s.cbm.n_row() * kLanes; }

bool has_moves(const State& s) { return s.last_move.size() == count_unknowns(s); }

/// Parts of a cell that are sent together. `near`: those that near processes have too.
struct CellParts {
  bool moves = false, near = false, shapes = false;
};
CellParts all_parts(const State& s) { return {has_moves(s), s.near_set != 0, true}; }

/// Number of a lane's sphere; none for a lane of a deformable cell, or without a cell.
std::optional<std::size_t> sphere_of(const State& s, std::size_t lane) {
  const std::size_t c = lane - s.dcm.n_lane();
  return lane >= s.dcm.n_lane() && c < s.cbm.n_cell() ? std::optional(c) : std::nullopt;
}

void put_ramp(const Ramp& r, std::vector<double>& out) {
  out.insert(out.end(), {r.from, r.to, r.start, r.end});
}
Ramp get_ramp(const double*& from) {
  const Ramp r{from[0], from[1], from[2], from[3]};
  from += 4;
  return r;
}

void put_cycle(const Cycle& c, std::vector<double>& out) {
  out.insert(out.end(),
             {static_cast<double>(c.parent), static_cast<double>(c.founder),
              static_cast<double>(c.fate), c.birth, c.birth_volume, c.duration, c.wait_until});
}
Cycle get_cycle(const double*& from) {
  const Cycle c{static_cast<std::int64_t>(from[0]),
                static_cast<std::int64_t>(from[1]),
                static_cast<Fate>(static_cast<int>(from[2])),
                from[3],
                from[4],
                from[5],
                from[6]};
  from += 7;
  return c;
}

}  // namespace

std::size_t exchange_lengths(const Ranks& ranks, ExchangePlan& plan) {
  ExchangePlan lengths;
  std::vector<double> sent, received(plan.peer.size());
  for (const ExchangePlan::Peer& p : plan.peer) {
    const std::size_t k = sent.size();
    lengths.peer.push_back({p.rank, k, k + 1, k, k + 1});
    sent.push_back(static_cast<double>(p.send_end - p.send_begin));
  }
  ranks.exchange<double>(lengths, sent, received);
  std::size_t total = 0;
  for (std::size_t k = 0; k < plan.peer.size(); ++k) {
    plan.peer[k].receive_begin = total;
    total += static_cast<std::size_t>(received[k]);
    plan.peer[k].receive_end = total;
  }
  return total;
}

std::size_t count_near_numbers(const State& s, std::size_t lane) {
  constexpr std::size_t kConstants = 9, kOfCycle = 7;
  const std::size_t points = 3 * static_cast<std::size_t>(points_of(s, lane));
  if (!sphere_of(s, lane)) return points;
  return points + kConstants + (s.cycle.empty() ? 0 : kOfCycle);
}

void pack_near(const State& s, std::size_t lane, std::vector<double>& out) {
  for_each_number_of(s, lane, [&](std::size_t k) { out.push_back(number_of(s, k)); });
  const std::optional<std::size_t> c = sphere_of(s, lane);
  if (!c) return;
  put_ramp(s.cbm.volume[*c], out);
  put_ramp(s.cbm.strength[*c], out);
  out.push_back(s.cbm.young[*c]);
  if (!s.cycle.empty()) put_cycle(s.cycle[lane], out);
}

const double* unpack_near(const double* from, std::size_t lane, State& s) {
  for_each_number_of(s, lane, [&](std::size_t k) { number_of(s, k) = *from++; });
  const std::optional<std::size_t> c = sphere_of(s, lane);
  if (!c) return from;
  s.cbm.volume[*c] = get_ramp(from);
  s.cbm.strength.set(*c, get_ramp(from));
  s.cbm.young.set(*c, *from++);
  if (!s.cycle.empty()) s.cycle[lane] = get_cycle(from);
  return from;
}

namespace {

/// Appends what only the holder of a cell has: its last move, what near processes have, lengths and
/// numbers of its shape of birth.
void pack(const State& s, std::size_t lane, const CellParts& parts, std::vector<double>& out) {
  if (parts.moves)
    for_each_number_of(s, lane, [&](std::size_t k) { out.push_back(s.last_move[k]); });
  if (parts.near) pack_near(s, lane, out);
  if (!parts.shapes || lane >= s.dcm.n_lane()) return;
  const dcm::BirthShape& b = s.dcm.birth[lane];
  for (const SharedNumbers* v : {&b.edge, &b.triangle, &b.link}) {
    out.push_back(static_cast<double>(v->size()));
    out.insert(out.end(), v->begin(), v->end());
  }
}

/// Reads what pack() wrote.   @return end of it
const double* unpack(const double* from, std::size_t lane, const CellParts& parts, State& s,
                     RowVector<double>& moves) {
  if (parts.moves) for_each_number_of(s, lane, [&](std::size_t k) { moves[k] = *from++; });
  if (parts.near) from = unpack_near(from, lane, s);
  if (!parts.shapes || lane >= s.dcm.n_lane()) return from;
  dcm::BirthShape& b = s.dcm.birth[lane];
  for (SharedNumbers* v : {&b.edge, &b.triangle, &b.link}) {
    const auto n = static_cast<std::size_t>(*from++);
    *v = std::vector<double>(from, from + n);
    from += n;
  }
  return from;
}

void forget_shape(State& s, std::size_t lane) {
  if (lane >= s.dcm.n_lane()) return;
  dcm::BirthShape& b = s.dcm.birth[lane];
  b.edge = b.triangle = b.link = SharedNumbers();
}

/// Gathers these cells on every process.
void gather_cells(const Ranks& ranks, std::span<const std::size_t> lanes, const CellParts& parts,
                  State& s) {
  std::vector<double> own, all;
  std::vector<std::size_t> start;
  for (const std::size_t lane : lanes)
    if (s.cell_holder[lane] == ranks.rank()) pack(s, lane, parts, own);
  ranks.gather<double>(own, all, &start);
  std::vector<const double*> next;
  for (const std::size_t first : start) next.push_back(all.data() + first);
  for (const std::size_t lane : lanes) {
    const int holder = s.cell_holder[lane];
    if (holder == kEverywhere || holder == ranks.rank()) continue;
    const double*& from = next[static_cast<std::size_t>(holder)];
    from = unpack(from, lane, parts, s, s.last_move);
  }
}

/// Lanes of cells that this process sends to another, and of those that it gets.
struct Handover {
  std::vector<std::size_t> send, receive;
};

/// Sends and receives cells; the moves of those that come go into `moves`.
void send_cells(const Ranks& ranks, const std::vector<Handover>& with, const CellParts& parts,
                State& s, RowVector<double>& moves) {
  ExchangePlan plan;
  std::vector<double> out;
  for (std::size_t rank = 0; rank < with.size(); ++rank) {
    if (with[rank].send.empty() && with[rank].receive.empty()) continue;
    const std::size_t first = out.size();
    for (const std::size_t lane : with[rank].send) pack(s, lane, parts, out);
    plan.peer.push_back({static_cast<int>(rank), first, out.size(), 0, 0});
  }
  std::vector<double> in(exchange_lengths(ranks, plan));
  ranks.exchange<double>(plan, out, in);
  const double* from = in.data();
  for (const Handover& h : with)
    for (const std::size_t lane : h.receive) from = unpack(from, lane, parts, s, moves);
}

bool are_with_owners(const Workspace& w, const State& s) {
  for (std::size_t lane = 0; lane < s.cell_holder.size(); ++lane)
    if (s.cell_holder[lane] != owner_of_lane(w, lane)) return false;
  return !s.cell_holder.empty();
}

/// True if every process keeps all of all cells: if each does all work, if constrained cells follow
/// their last moves, or for the check of explicit Euler.
bool keeps_all(const World& world, const Workspace& w) {
  return w.system.ownership.is_whole() || w.constraint.applies() ||
         world.params.numerics.integrator == Integrator::kExplicitEuler;
}

}  // namespace

void keep_own_moves(const Workspace& w, State& s) {
  if (!has_moves(s)) s.last_move = make_zeros<double>(w.move.size());  // the first step
  for_each_own_number(w.system, [&](std::size_t k) { s.last_move[k] = w.move[k]; });
}

void hand_over_cells(World& world, const Workspace& w) {
  State& s = world.state;
  if (keeps_all(world, w)) return complete_cells(world.ranks, s);
  forget_near(s);
  if (are_with_owners(w, s)) return;
  const int self = world.ranks.rank();
  std::vector<Handover> with(static_cast<std::size_t>(world.ranks.size()));
  if (s.cell_holder.empty())
    s.cell_holder = {count_lanes(s), [](std::size_t) { return kEverywhere; }};
  const bool moves = has_moves(s);
  RowVector<double> own = make_zeros<double>(moves ? s.last_move.size() : 0);
  for (std::size_t lane = 0; lane < s.cell_holder.size(); ++lane) {
    const int from = s.cell_holder[lane], to = owner_of_lane(w, lane);
    if (to == self && from != self && from != kEverywhere)
      with[static_cast<std::size_t>(from)].receive.push_back(lane);
    else if (to == self && moves)
      for_each_number_of(s, lane, [&](std::size_t k) { own[k] = s.last_move[k]; });
    else if (from == self && to != self)
      with[static_cast<std::size_t>(to)].send.push_back(lane);
  }
  send_cells(world.ranks, with, {.moves = moves, .near = s.near_set != 0, .shapes = true}, s, own);
  s.cell_holder = {count_lanes(s), [&](std::size_t lane) { return owner_of_lane(w, lane); }};
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane)
    if (s.cell_holder[lane] != self) forget_shape(s, lane);
  if (moves) s.last_move = std::move(own);
}

namespace {

/// Gathers all cells, a part at a time.
void gather_all(const Ranks& ranks, const CellParts& parts, State& s) {
  constexpr std::size_t kMostPoints = 100'000;  // at a time: some 6 MB
  std::vector<std::size_t> lanes;
  std::size_t n = 0;
  for (std::size_t lane = 0; lane < s.cell_holder.size(); ++lane) {
    lanes.push_back(lane);
    n += static_cast<std::size_t>(points_of(s, lane));
    if (n < kMostPoints && lane + 1 < s.cell_holder.size()) continue;
    gather_cells(ranks, lanes, parts, s);
    lanes.clear();
    n = 0;
  }
}

}  // namespace

void complete_near(const Ranks& ranks, State& s) {
  if (s.near_set == 0) return;
  gather_all(ranks, {.near = true}, s);
  s.near_set = 0;
  s.near.clear();
}

void drop_far(const Ranks& ranks, State& s, bool poison) {
  const std::size_t n_lane = s.cell_holder.size(), n_dcm = s.dcm.position.size();
  const double nothing = poison ? std::numeric_limits<double>::quiet_NaN() : 0;
  std::vector<std::uint8_t> stays(n_lane, 0);
  for (std::size_t lane = 0; lane < n_lane; ++lane)
    if (const int holder = s.cell_holder[lane]; holder == ranks.rank() || holder == kEverywhere)
      stays[lane] = 1;
  for (const std::size_t lane : s.near) stays[lane] = 1;

  HeldRows<double> dcm = make_zeros<double>(n_dcm), cbm = make_zeros<double>(s.cbm.position.size());
  for (std::size_t lane = 0; lane < n_lane; ++lane)
    if (stays[lane] != 0 || poison)
      for_each_number_of(s, lane, [&](std::size_t k) {
        (k < n_dcm ? dcm[k] : cbm[k - n_dcm]) = stays[lane] != 0 ? number_of(s, k) : nothing;
      });
  s.dcm.position = std::move(dcm);
  s.cbm.position = std::move(cbm);

  const std::size_t first = s.dcm.n_lane(), n = s.cbm.n_cell();
  HeldRows<Ramp> volume = make_zeros<Ramp>(n);
  for (std::size_t c = 0; c < n; ++c)
    if (stays[first + c] != 0 || poison)
      volume[c] = stays[first + c] != 0 ? s.cbm.volume[c] : Ramp::constant(nothing);
  s.cbm.volume = std::move(volume);
  const auto keep = [&](auto& values, const auto& absent) {
    values = {n, [&](std::size_t c) { return stays[first + c] != 0 ? values[c] : absent; }};
  };
  keep(s.cbm.strength, Ramp::constant(poison ? nothing : 1));
  keep(s.cbm.young, nothing);
  if (s.cycle.empty()) return;
  HeldRows<Cycle> cycle = make_zeros<Cycle>(s.cycle.size());
  for (std::size_t lane = 0; lane < s.cycle.size(); ++lane)
    if (lane < first || stays[lane] != 0) cycle[lane] = s.cycle[lane];
  s.cycle = std::move(cycle);
}

void complete_cells(const Ranks& ranks, State& s) {
  gather_all(ranks, all_parts(s), s);
  s.cell_holder.clear();
  s.near_set = 0;
  s.near.clear();
}

void bring_points(const Ranks& ranks, std::span<const std::size_t> lanes, State& s) {
  if (s.near_set != 0) gather_cells(ranks, lanes, {.near = true}, s);
}

void forget_near(State& s) {
  if (s.near_set != 0) s.near_set = kOwnPoints;
  s.near.clear();
}

void complete_shapes(const Ranks& ranks, std::span<const std::size_t> lanes, State& s) {
  if (!s.cell_holder.empty()) gather_cells(ranks, lanes, {.shapes = true}, s);
}

}  // namespace acinus::coupling
