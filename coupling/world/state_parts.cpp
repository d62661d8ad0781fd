#include "coupling/world/state_parts.hpp"

#include <algorithm>
#include <array>

namespace acinus::coupling {
namespace {

constexpr std::size_t kMostNumbers = 250'000;  ///< that are on their way at a time: 2 MB

/// Lanes [first, end) of a range whose points are at most kMostNumbers numbers; at least one lane.
std::size_t end_of_part(const State& s, std::size_t first, std::size_t end) {
  std::size_t n = 0, lane = first;
  do n += 3 * static_cast<std::size_t>(points_of(s, lane));
  while (++lane < end && n < kMostNumbers);
  return lane;
}

/// Numbers of all rows of these lanes, [row][3][lane].
/// @param range   whole blocks
/// @param number  number(k): number k of the points of a held cell
template <class Number>
void visit_rows(const Ranks& ranks, const State& s, LaneRange range, const Number& number,
                const TakeNumbers& take) {
  io::PartBuffer<double> out(take);
  std::vector<double> rows;  // of a block
  visit_lanes(
      ranks, s, range,
      [&](std::size_t lane, std::vector<double>& own) {
        for_each_number_of(s, lane, [&](std::size_t k) { own.push_back(number(k)); });
      },
      [&](std::size_t lane, std::span<const double> own) {
        const std::size_t in_block = lane % kLanes;
        rows.resize(own.size() * kLanes);
        for (std::size_t k = 0; k < own.size(); ++k) rows[k * kLanes + in_block] = own[k];
        if (in_block + 1 == kLanes) out.put(rows);
      });
  out.hand_over();
}

LaneRange lanes_of_sphere_rows(const State& s) {
  return {s.dcm.n_lane(), s.dcm.n_lane() + s.cbm.n_row() * kLanes};
}

using Sent = std::array<int, 2>;

/// True if this process hands a pair over: the holder of its first sphere does, for contacts of all
/// processes the root.
bool sends(const Ranks& ranks, const State& s, const std::pair<int, int>& pair) {
  const int holder = s.holder[static_cast<std::size_t>(pair.first)];
  return holder == ranks.rank() || (holder == kEverywhere && ranks.is_root());
}

}  // namespace

void visit_lanes(const Ranks& ranks, const State& s, LaneRange range,
                 const std::function<void(std::size_t, std::vector<double>&)>& append,
                 const std::function<void(std::size_t, std::span<const double>)>& take) {
  std::vector<double> own, all;
  if (s.cell_holder.empty()) {
    for (std::size_t lane = range.first; lane < range.end; ++lane) {
      own.clear();
      append(lane, own);
      take(lane, own);
    }
    return;
  }
  const auto sender = [&s](std::size_t lane) { return std::max(0, s.cell_holder[lane]); };
  std::vector<std::size_t> next;  // [rank] place in `all`
  for (std::size_t first = range.first; first < range.end;) {
    const std::size_t end = end_of_part(s, first, range.end);
    own.clear();
    for (std::size_t lane = first; lane < end; ++lane) {
      if (sender(lane) != ranks.rank()) continue;
      const std::size_t count = own.size();
      own.push_back(0);
      append(lane, own);
      own[count] = static_cast<double>(own.size() - count - 1);
    }
    ranks.gather_at_root<double>(own, all, &next);
    for (std::size_t lane = first; lane < end && ranks.is_root(); ++lane) {
      std::size_t& from = next[static_cast<std::size_t>(sender(lane))];
      const auto n = static_cast<std::size_t>(all[from]);
      take(lane, std::span(all).subspan(from + 1, n));
      from += n + 1;
    }
    first = end;
  }
}

void visit_shell_positions(const Ranks& ranks, const State& s, const TakeNumbers& take) {
  if (s.cell_holder.empty()) return take(s.dcm.position);
  visit_rows(
      ranks, s, shell_lanes(s), [&s](std::size_t k) { return number_of(s, k); }, take);
}

void visit_sphere_positions(const Ranks& ranks, const State& s, const TakeNumbers& take) {
  if (s.cell_holder.empty()) return take(s.cbm.position);
  visit_rows(
      ranks, s, lanes_of_sphere_rows(s), [&s](std::size_t k) { return number_of(s, k); }, take);
}

void visit_last_move(const Ranks& ranks, const State& s, const TakeNumbers& take) {
  const std::span<const double> all(s.last_move);
  const std::size_t n_cells = s.dcm.position.size() + s.cbm.position.size();
  if (s.cell_holder.empty() || all.size() != count_unknowns(s)) return take(all);
  const auto move = [all](std::size_t k) { return all[k]; };
  visit_rows(ranks, s, {0, lanes_of_sphere_rows(s).end}, move, take);
  if (ranks.is_root()) take(all.subspan(n_cells));  // of vessels
}

std::size_t count_touching(const Ranks& ranks, const State& s) {
  if (s.holder.empty()) return s.cbm.touching.size();
  const auto own = static_cast<std::size_t>(std::ranges::count_if(
      s.cbm.touching, [&](const auto& pair) { return sends(ranks, s, pair); }));
  std::vector<std::size_t> all;
  ranks.gather<std::size_t>(std::span(&own, 1), all);
  std::size_t n = 0;
  for (const std::size_t k : all) n += k;
  return n;
}

void visit_touching(const Ranks& ranks, const State& s,
                    const std::function<void(std::span<const std::pair<int, int>>)>& take) {
  if (s.holder.empty()) return take(s.cbm.touching);
  constexpr std::size_t kMostSpheres = 50'000;  // at a time
  auto next = s.cbm.touching.begin();
  std::vector<Sent> own, all;
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t end = kMostSpheres; end < s.cbm.n_cell() + kMostSpheres; end += kMostSpheres) {
    own.clear();
    for (; next != s.cbm.touching.end() && static_cast<std::size_t>(next->first) < end; ++next)
      if (sends(ranks, s, *next)) own.push_back({next->first, next->second});
    ranks.gather_at_root<Sent>(own, all, nullptr);
    pairs.clear();
    for (const auto& [a, b] : all) pairs.emplace_back(a, b);
    std::ranges::sort(pairs);
    take(pairs);
  }
}

}  // namespace acinus::coupling
