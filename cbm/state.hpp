#pragma once
/// State of all centre-based cells: exactly what a checkpoint holds.

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/numbers/lanes.hpp"
#include "core/numbers/ramp.hpp"
#include "core/parallel/paged_values.hpp"
#include "core/parallel/row_vector.hpp"
#include "core/selected_cell.hpp"
#include "core/vec.hpp"
#include "solve/system.hpp"

namespace acinus::cbm {

/// State of the cells. Cell c stands in lane c % kLanes of row c / kLanes; the tail lanes of the
/// last row are empty.
struct State {
  HeldRows<double> position;          ///< [rows][3][lane] um
  std::vector<std::int64_t> lineage;  ///< [n_cell]
  HeldRows<Ramp> volume;              ///< [n_cell] um^3, intrinsic volume
  PagedValues<int> type;              ///< [n_cell]
  PagedValues<Ramp> strength;         ///< [n_cell] 0..1, rises after birth; see CellData
  PagedValues<double> young;          ///< [n_cell] kPa
  PagedValues<Vec3> pull;             ///< [n_cell] nN, constant load
  /// Adhesive contacts in existence, as (cell, cell) or (cell, ~boundary key); sorted. JKR contact
  /// has hysteresis, so this is state.
  std::vector<std::pair<int, int>> touching;

  std::size_t n_cell() const { return lineage.size(); }
  std::size_t n_row() const { return position.size() / kPointStride; }
};

struct NewCell {
  std::int64_t lineage = 0;
  int type = 0;
  Vec3 center = Vec3::Zero();
  double radius = 0;  ///< um
  double young = 0;   ///< kPa
  Vec3 pull = Vec3::Zero();
  Ramp strength = Ramp::constant(1);  ///< below one only after a division
};

State make_state(const std::vector<NewCell>& cells);

/// Copies cells into a new state, in the order given. Contacts in existence between cells of one
/// state, or with the boundary, are kept.
/// @param absent  [cells] not 0: place and volume are not known and not copied; empty: all are
State compose(std::span<const SelectedCell<State>> cells,
              std::span<const std::uint8_t> absent = {});

/// Address in arrays that start with the CBM rows at `first_row`.
inline Address cell_address(std::size_t first_row, std::size_t cell) {
  return make_address(first_row + cell / kLanes, static_cast<int>(cell % kLanes));
}
/// Number of a cell's point in the solver.
inline solve::Point cell_point(std::size_t first_row, std::size_t cell) {
  return static_cast<solve::Point>(first_row * kLanes + cell);
}
inline Vec3 center_of(const State& s, std::size_t cell) {
  return load_point(s.position.data(), cell_address(0, cell));
}

/// Radii from the intrinsic volumes at a time, um.
std::vector<double> radii_at(const State& state, double time);

/// Strengths at a time; empty when all are 1.
std::vector<double> strengths_at(const State& state, double time);

/// Cell data of the contact search at one time, that of the end of the step.
struct CellData {
  std::span<const double> radius;         ///< [n_cell] um
  std::span<const double> strength = {};  ///< [n_cell] 0..1; empty: all 1
  std::span<const std::int64_t> mother =
      {};                                 ///< [n_cell] lineage, -1: none; empty: all are sisters
  std::span<const double> adhesion = {};  ///< [n_cell] factor on adhesion to cells; empty: all 1

  double strength_of(std::size_t cell) const { return strength.empty() ? 1 : strength[cell]; }
  /// Share of a contact of two spheres. Only sisters, which are born deep in each other, separate
  /// slowly. Neighbours act on a daughter with full force, newborn or not: otherwise they would
  /// move into the mother's place, or into each other, before she is strong.
  double pair_share(std::size_t a, std::size_t b) const {
    if (strength.empty()) return 1;
    const bool sisters = mother.empty() || (mother[a] >= 0 && mother[a] == mother[b]);
    return sisters ? std::max(strength[a], strength[b]) : 1;
  }
};

/// Appends the blocks of unknowns of these cells.
void append_blocks(const State& state, solve::Blocks& blocks);

}  // namespace acinus::cbm
