#pragma once
/// Input and scratch of the contact search of spheres.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cbm/params.hpp"
#include "cbm/state.hpp"
#include "cbm/stiffness_law.hpp"
#include "contact/boundary.hpp"
#include "contact/neighbours.hpp"
#include "contact/vessel_side.hpp"
#include "core/parallel/row_vector.hpp"
#include "geometry/network.hpp"

namespace acinus::cbm {

struct ContactParams {
  double skin = 0.3;           ///< um
  double adhesion_factor = 1;  ///< ramps up after start-up
  double friction_factor = 1;  ///< 0 while cells grow to size
};

/// Input of the stages of the contact search.
struct ContactInput {
  const State& state;
  std::span<const Params> params;  ///< [type]
  const ContactParams& options;
  CellData cells;
  const contact::Boundary& boundary;
  double time = 0;                            ///< s, at which moving walls are evaluated
  std::size_t first_row = 0;                  ///< first CBM row in the system
  std::size_t vessel_row = contact::kAtRest;  ///< first row of the nodes of moving vessels
};

/// Constants of two cell types in the law between two spheres.
struct TypePair {
  double adhesion = 0;  ///< W, nN/um
  double friction = 0;  ///< nN s/um^3
};

/// Scratch of the contact search. Cells are partitioned into one range per thread. A thread adds to
/// the cells of its own range only and computes pairs across ranges redundantly.
struct ContactWorkspace {
  /// [n_cell] 1: does not move; empty: all move. Set by the caller. Their contacts with constrained
  /// deformable cells are left out.
  std::vector<std::uint8_t> constrained;
  /// [n_cell] kFar: ghost cell, computed by another process; empty: none. Set by the caller.
  /// refresh_pairs and the DCM-CBM interface make those near own cells kNear. Sums over the
  /// contacts of a cell are complete for own cells only, and kFar cells have no numbers. kAbsent
  /// ones, which are set by the caller too, have no position either.
  std::vector<std::uint8_t> ghost;
  /// Near pairs with an own cell, ascending; written by: refresh_pairs
  std::vector<std::pair<int, int>> pair;
  std::vector<std::pair<int, int>> segment;      ///< (cell, vessel segment) near pairs
  RowVector<double> list_position, list_radius;  ///< of own cells; written by: refresh_pairs
  geometry::Network list_network;                ///< moving vessels at the last rebuild
  RowVector<double> force;  ///< [n_row][3][lane] nN of all pairs; by: find_contacts
  std::vector<std::pair<int, int>> touching;  ///< new touching set, committed with an accepted step
  std::vector<std::vector<std::pair<int, int>>> touching_part;  ///< of other threads than the first
  std::vector<double> type_softness;  ///< [type] 1 - nu^2; written by: find_contacts
  std::vector<TypePair> type_pair;    ///< [type][type]; written by: find_contacts
  RowVector<double> contact_area;     ///< [n_cell] um^2, sum over all contacts
  /// [n_cell] sum of the relative overlaps with cells and walls, without vessels and meshes;
  /// written by: compute_overlaps; the DCM-CBM interface adds its own. Empty: no law needs it.
  std::vector<double> overlap_sum;
  /// [n_cell] number of contacts in overlap_sum, each weighted by its strength. Empty: no law takes
  /// the mean.
  std::vector<double> overlap_count;
  RowVector<Modulus> modulus;  ///< [n_cell] kPa, from the overlaps; written by: find_contacts
  /// [n_cell] nN/um, upper bound C_i of the stiffness that a contact gains because the modulus of
  /// the cell grows with all its overlaps; written by: find_contacts. Empty: no law corrects.
  std::vector<double> coupling;
  std::vector<double> scratch;  ///< of one function at a time
  int list_builds = 0;
  std::int64_t searches = 0;               ///< calls of find_contacts
  std::int64_t corrected = 0, beyond = 0;  ///< moduli by a law, and those beyond its range

  static constexpr std::uint8_t kFar = 1, kNear = 2, kAbsent = contact::kAbsentSphere;
  bool is_constrained(std::size_t cell) const {
    return !constrained.empty() && constrained[cell] != 0;
  }
  bool is_ghost(std::size_t cell) const { return !ghost.empty() && ghost[cell] != 0; }
  bool is_absent(std::size_t cell) const { return !ghost.empty() && ghost[cell] == kAbsent; }
  bool is_far(std::size_t cell) const {
    return !ghost.empty() && (ghost[cell] == kFar || ghost[cell] == kAbsent);
  }
  /// Makes a ghost cell one with numbers.
  void come_near(std::size_t cell) {
    if (is_ghost(cell)) ghost[cell] = kNear;
  }
};

}  // namespace acinus::cbm
