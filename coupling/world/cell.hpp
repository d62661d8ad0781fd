#pragma once
/// Cells of either model, addressed alike.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Index into arrays over [dcm lanes, then cbm cells].
inline std::size_t cell_index(const State& s, std::size_t sphere) {
  return s.dcm.n_lane() + sphere;
}

/// Cell of either model.
struct Cell {
  bool deformable;
  std::size_t at;     ///< lane or sphere
  std::size_t index;  ///< index into arrays over [dcm lanes, then cbm cells]
};

template <class F>
void for_each_cell(const State& s, F f) {
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l)) f(Cell{true, l, l});
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c) f(Cell{false, c, cell_index(s, c)});
}
/// All cells, in the order of for_each_cell.
std::vector<Cell> list_cells(const State& state);
inline std::int64_t lineage_of(const State& s, const Cell& c) {
  return c.deformable ? s.dcm.lineage[c.at] : s.cbm.lineage[c.at];
}
inline int type_of(const State& s, const Cell& c) {
  return c.deformable ? s.dcm.group[c.at / kLanes].type : s.cbm.type[c.at];
}
inline Ramp& volume_of(State& s, const Cell& c) {
  return c.deformable ? s.dcm.volume[c.at] : s.cbm.volume[c.at];
}
inline const Ramp& volume_of(const State& s, const Cell& c) {
  return c.deformable ? s.dcm.volume[c.at] : s.cbm.volume[c.at];
}
inline Vec3 center_of(const State& s, const Cell& c) {
  return c.deformable ? dcm::cell_center(s.dcm, c.at) : cbm::center_of(s.cbm, c.at);
}
inline const CycleParams& cycle_of(const Params& p, const State& s, const Cell& c) {
  return p.life.type[type_of(s, c)];
}

/// Cells by lineage.
using CellIndex = std::unordered_map<std::int64_t, Cell>;
CellIndex index_cells(const State& state);

/// Finds the living cell of a lineage. Linear in the number of cells; index_cells serves repeated
/// searches.
std::optional<Cell> find_cell(const State& state, std::int64_t lineage);

/// Calls f with the address of each point of a cell among all unknowns.
template <class F>
void for_each_point(const State& s, const Cell& c, F f) {
  if (!c.deformable) return f(cbm::cell_address(s.dcm.n_row(), c.at));
  const int n = s.dcm.group[c.at / kLanes].n_point();
  for (int i = 0; i < n; ++i) f(dcm::node_address(s.dcm, c.at, i));
}

/// Time since t = 0, s.   @pre Phase::kRun
inline double time_of(const State& s) { return s.clock.time - s.clock.origin; }

}  // namespace acinus::coupling
