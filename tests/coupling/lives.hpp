#pragma once
/// Small worlds whose cells grow, divide and die.

#include <gtest/gtest.h>
#include <algorithm>

#include <map>
#include <vector>

#include "coupling/life/life.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/world/cell.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {

inline constexpr double kDay = 86400;                             ///< s
inline const double kBirthVolume = 4.0 / 3 * kPi * 12 * 12 * 12;  ///< um^3, of 12 um
inline const double kMotherRadius = 12 * std::cbrt(2.0);          ///< um

inline CycleParams cycle_params(double spread = 0.1) {
  CycleParams p;
  p.time = kDay;
  p.spread = spread;
  return p;
}

/// Cells that double every 24 h +-10 %, stepped as in a run.
inline World make_living_world(const std::vector<TestCell>& cells, int n_node = 42,
                               double step = 60) {
  World w = make_test_world(cells, step, n_node);
  w.params.life.type = {cycle_params()};
  w.state.next_lineage = static_cast<std::int64_t>(cells.size());
  w.params.numerics.adaptive = true;
  w.params.numerics.max_move = 0.3;
  return w;
}

/// Begins life, with all cells of the size of mothers about to divide.
inline void begin_with_mothers(World& w) {
  begin_life(w);
  for_each_cell(w.state, [&](const Cell& c) {
    const double volume = volume_of(w.state, c).at(w.state.clock.time);
    volume_of(w.state, c) = Ramp::constant(volume);
    if (volume > 1.5 * kBirthVolume) w.state.cycle[c.index].birth_volume = volume / 2;
  });
}

/// Events of life at a later time, without motion before it.
inline LifeReport look(World& w, double time) {
  w.state.clock.time = time;
  SizedWorkspace work(w);
  return live(w, work);
}

inline std::vector<std::int64_t> lineages(const State& s) {
  std::vector<std::int64_t> all;
  for (const auto& [id, c] : index_cells(s)) all.push_back(id);
  std::ranges::sort(all);
  return all;
}

inline int count_events(const LifeReport& r, EventKind kind) {
  int n = 0;
  for (const LifeEvent& e : r.events) n += e.kind == kind ? 1 : 0;
  return n;
}

}  // namespace acinus::coupling
