#pragma once
/// State of all centre-based cells: exactly what a checkpoint holds.

#include <cstdint>
#include <utility>
#include <vector>

#include "core/lanes.hpp"
#include "core/ramp.hpp"
#include "core/solve/system.hpp"
#include "core/vec.hpp"

namespace acinus::cbm {

/// Cell c stands in lane c % kLanes of row c / kLanes; the tail lanes of the last row are empty.
struct State {
  std::vector<double> position;       ///< [rows][3][lane] um
  std::vector<std::int64_t> lineage;  ///< [n_cell]
  std::vector<int> type;              ///< [n_cell]
  std::vector<Ramp> volume;           ///< [n_cell] um^3, intrinsic volume
  std::vector<double> young;          ///< [n_cell] kPa
  std::vector<Vec3> pull;             ///< [n_cell] nN, constant load
  /// Adhesive contacts that exist, as (cell, cell) or (cell, ~surroundings key); sorted. JKR
  /// contact has hysteresis, so this is state.
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
};

State make_state(const std::vector<NewCell>& cells);

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

/// The blocks of unknowns these cells contribute.
std::vector<solve::Block> make_blocks(const State& state);

}  // namespace acinus::cbm
