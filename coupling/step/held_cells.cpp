#include "coupling/step/held_cells.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "coupling/step/ghost_cells.hpp"

namespace acinus::coupling {
namespace {

/// Lanes of all blocks of cells, with empty ones.
std::size_t count_lanes(const State& s) { return s.dcm.n_lane() + s.cbm.n_row() * kLanes; }

bool has_moves(const State& s) { return s.last_move.size() == count_unknowns(s); }

/// Points of a lane.
int points_of(const State& s, std::size_t lane) {
  return lane < s.dcm.n_lane() ? s.dcm.group[lane / kLanes].n_point() : 1;
}

/// Calls f(k) for the indices k of a lane's numbers in vectors [n_row][3][lane].
template <class F>
void for_each_number_of(const State& s, std::size_t lane, const F& f) {
  const std::size_t first = lane < s.dcm.n_lane()
                                ? dcm::node_address(s.dcm, lane, 0)
                                : cbm::cell_address(s.dcm.n_row(), lane - s.dcm.n_lane());
  const auto n = static_cast<std::size_t>(points_of(s, lane));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t m = 0; m < 3; ++m) f(first + i * kPointStride + m * kLanes);
}

/// Appends what only the holder of a cell has: lengths and numbers of its shape of birth, after its
/// last move if that is wanted.
void pack(const State& s, std::size_t lane, bool moves, std::vector<double>& out) {
  if (moves) for_each_number_of(s, lane, [&](std::size_t k) { out.push_back(s.last_move[k]); });
  if (lane >= s.dcm.n_lane()) return;
  const dcm::BirthShape& b = s.dcm.birth[lane];
  for (const SharedNumbers* v : {&b.edge, &b.triangle, &b.link}) {
    out.push_back(static_cast<double>(v->size()));
    out.insert(out.end(), v->begin(), v->end());
  }
}

/// Reads what pack() wrote.   @return end of it
const double* unpack(const double* from, std::size_t lane, State& s, RowVector<double>* moves) {
  if (moves != nullptr) for_each_number_of(s, lane, [&](std::size_t k) { (*moves)[k] = *from++; });
  if (lane >= s.dcm.n_lane()) return from;
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

enum class Where { kRoot, kEverywhere };

/// Gathers these cells at the root or on every process.
void gather_cells(const Ranks& ranks, Where where, std::span<const std::size_t> lanes, bool moves,
                  State& s) {
  std::vector<double> own, all;
  std::vector<std::size_t> start;
  for (const std::size_t lane : lanes)
    if (s.cell_holder[lane] == ranks.rank()) pack(s, lane, moves, own);
  if (where == Where::kEverywhere)
    ranks.gather<double>(own, all, &start);
  else
    ranks.gather_at_root<double>(own, all, &start);
  if (all.empty()) return;
  std::vector<const double*> next;
  for (const std::size_t first : start) next.push_back(all.data() + first);
  for (const std::size_t lane : lanes) {
    const int holder = s.cell_holder[lane];
    if (holder == kEverywhere || holder == ranks.rank()) continue;
    const double*& from = next[static_cast<std::size_t>(holder)];
    from = unpack(from, lane, s, moves ? &s.last_move : nullptr);
  }
}

/// Lanes of cells that this process sends to another, and of those that it gets.
struct Handover {
  std::vector<std::size_t> send, receive;
};

/// Sends and receives cells; the moves of those that come go into `moves` if it is not null.
void send_cells(const Ranks& ranks, const std::vector<Handover>& with, State& s,
                RowVector<double>* moves) {
  ExchangePlan lengths, plan;
  std::vector<double> out, n_out, n_in;
  for (std::size_t rank = 0; rank < with.size(); ++rank) {
    const auto& [send, receive] = with[rank];
    if (send.empty() && receive.empty()) continue;
    const int peer = static_cast<int>(rank);
    const std::size_t first = out.size();
    for (const std::size_t lane : send) pack(s, lane, moves != nullptr, out);
    plan.peer.push_back({peer, first, out.size(), 0, 0});
    const std::size_t n_sent = n_out.size(), n_got = n_in.size();
    if (!send.empty()) n_out.push_back(static_cast<double>(out.size() - first));
    if (!receive.empty()) n_in.push_back(0);
    lengths.peer.push_back({peer, n_sent, n_out.size(), n_got, n_in.size()});
  }
  ranks.exchange<double>(lengths, n_out, n_in);
  std::size_t total = 0;
  for (std::size_t k = 0; k < plan.peer.size(); ++k) {
    plan.peer[k].receive_begin = total;
    for (std::size_t n = lengths.peer[k].receive_begin; n < lengths.peer[k].receive_end; ++n)
      total += static_cast<std::size_t>(n_in[n]);
    plan.peer[k].receive_end = total;
  }
  std::vector<double> in(total);
  ranks.exchange<double>(plan, out, in);
  const double* from = in.data();
  for (const Handover& h : with)
    for (const std::size_t lane : h.receive) from = unpack(from, lane, s, moves);
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
  send_cells(world.ranks, with, s, moves ? &own : nullptr);
  s.cell_holder = {count_lanes(s), [&](std::size_t lane) { return owner_of_lane(w, lane); }};
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane)
    if (s.cell_holder[lane] != self) forget_shape(s, lane);
  if (moves) s.last_move = std::move(own);
}

namespace {

/// Gathers all cells, a part at a time.
void gather_all(const Ranks& ranks, Where where, State& s) {
  constexpr std::size_t kMostPoints = 100'000;  // at a time: some 6 MB
  std::vector<std::size_t> lanes;
  std::size_t n = 0;
  for (std::size_t lane = 0; lane < s.cell_holder.size(); ++lane) {
    lanes.push_back(lane);
    n += static_cast<std::size_t>(points_of(s, lane));
    if (n < kMostPoints && lane + 1 < s.cell_holder.size()) continue;
    gather_cells(ranks, where, lanes, has_moves(s), s);
    lanes.clear();
    n = 0;
  }
}

}  // namespace

void complete_cells(const Ranks& ranks, State& s) {
  gather_all(ranks, Where::kEverywhere, s);
  s.cell_holder.clear();
}

void bring_cells_to_root(const Ranks& ranks, State& s) { gather_all(ranks, Where::kRoot, s); }

void drop_cells(const Ranks& ranks, State& s) {
  if (s.cell_holder.empty()) return;
  RowVector<double> own = make_zeros<double>(s.last_move.size());
  for (std::size_t lane = 0; lane < s.cell_holder.size(); ++lane)
    if (s.cell_holder[lane] != ranks.rank() && s.cell_holder[lane] != kEverywhere)
      forget_shape(s, lane);
    else if (has_moves(s))
      for_each_number_of(s, lane, [&](std::size_t k) { own[k] = s.last_move[k]; });
  s.last_move = std::move(own);
}

void complete_shapes(const Ranks& ranks, std::span<const std::size_t> lanes, State& s) {
  if (!s.cell_holder.empty()) gather_cells(ranks, Where::kEverywhere, lanes, false, s);
}

}  // namespace acinus::coupling
