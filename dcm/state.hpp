#pragma once
/// State of all deformable cells: exactly what a checkpoint holds.
///
/// Cells stand in groups of eight lanes that share one mesh topology and one cell type. A lane
/// index (group * kLanes + lane) names a cell within the arrays; its lineage id names it for ever.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/numbers/lanes.hpp"
#include "core/numbers/ramp.hpp"
#include "core/parallel/row_vector.hpp"
#include "core/selected_cell.hpp"
#include "core/vec.hpp"
#include "dcm/birth_shape.hpp"
#include "dcm/edge_tension.hpp"
#include "dcm/params.hpp"
#include "geometry/topology.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

inline constexpr std::int64_t kEmptyLane = -1;

struct Group {
  const geometry::Topology* topology = nullptr;  ///< shared, never owned
  std::size_t first_row = 0;                     ///< first node row in State::position
  int type = 0;                                  ///< index into the params
  NucleusMesh nucleus{};

  /// Points of a cell: nodes of its cortex, then those of its nucleus.
  int n_point() const { return topology->n_node + nucleus.n_node(); }
  std::size_t first_nucleus_row() const {
    return first_row + static_cast<std::size_t>(topology->n_node);
  }
};

struct State {
  std::vector<Group> group;
  HeldRows<double> position;  ///< [rows][3][lane] um; empty lanes hold rest icospheres
  // Per lane, [n_group * kLanes]:
  std::vector<std::int64_t> lineage;  ///< kEmptyLane where no cell is
  std::vector<Ramp> volume;  ///< um^3, reference volume V0(t); Eq. (18) is its linear growth
  std::vector<BirthShape> birth;
  std::vector<EdgeTension> tension;  ///< of cells whose springs have a dashpot in series
  std::vector<Vec3> pull;            ///< nN, constant load spread over the cell

  std::size_t n_lane() const { return lineage.size(); }
  std::size_t n_row() const { return position.size() / kPointStride; }
  bool active(std::size_t lane) const { return lineage[lane] != kEmptyLane; }
};

/// New cell to be placed: a sphere of the given reference radius.
struct NewCell {
  std::int64_t lineage = 0;
  int type = 0;
  const geometry::Topology* topology = nullptr;
  Vec3 center = Vec3::Zero();
  double radius = 0;  ///< um, (3 V0 / 4 pi)^(1/3)
  Vec3 pull = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();  ///< orientation of the meshes
  NucleusMesh nucleus{};
};

/// Groups cells by type and topology in the order given (put them in space-filling order first).
State make_state(const std::vector<NewCell>& cells);

/// Copies cells into a new state, grouped by type and topology in the order given.
/// @param lane    [cells] written: lane of each in the new state
/// @param absent  [cells] not 0: its points are not known and not copied; empty: all are
State compose(std::span<const SelectedCell<State>> cells, std::vector<std::size_t>& lane,
              std::span<const std::uint8_t> absent = {});

/// Number of cells (not lanes).
int count_cells(const State& state);

/// Reference radius (3 V0 / 4 pi)^(1/3) of every lane, um. Empty lanes: 1.
std::vector<double> reference_radii(const State& state, double time);
void refresh_reference_radii(const State& state, double time, std::vector<double>& radius);

/// Address of a node, or of any point of the cell, in arrays that start with the DCM rows.
inline Address node_address(const State& state, std::size_t lane, int node) {
  return make_address(state.group[lane / kLanes].first_row + node, static_cast<int>(lane % kLanes));
}

/// Mean of the nodes weighted by their share of the rest surface.
Vec3 cell_center(const State& state, std::size_t lane);

/// Scales all points of a cell about its centre.
void scale_cell(double factor, std::size_t lane, State& state);

/// Copies the nodes of one cell's cortex out of the lanes.
void copy_nodes(const State& state, std::size_t lane, std::vector<Vec3>& node);
/// Sets the nodes of one cell's cortex.   @param node  [n_node] um
void store_nodes(std::span<const Vec3> node, std::size_t lane, State& state);

/// Copies the nodes of one cell's nucleus: none without one.
void copy_nucleus(const State& state, std::size_t lane, std::vector<Vec3>& node);
/// Sets the nodes of one cell's nucleus.   @param node  [n_node of the nucleus] um
void store_nucleus(std::span<const Vec3> node, std::size_t lane, State& state);

inline bool has_nuclei(const State& s) {
  return std::ranges::any_of(s.group, [](const Group& g) { return g.nucleus.exists(); });
}

/// Blocks of unknowns of these cells, in order.
/// @param constrained  [n_lane] 1: does not move; empty: all move. Groups without a moving cell
///     have no internal terms.
std::vector<solve::Block> make_blocks(const State& state, std::span<const Params> params,
                                      std::span<const std::uint8_t> constrained = {});

/// Sets the dashpots of the blocks from these parameters.
/// @param block  of these cells, and perhaps others after them
void set_dashpots(const State& state, std::span<const Params> params,
                  std::span<solve::Block> block);

}  // namespace acinus::dcm
