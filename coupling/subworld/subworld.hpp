#pragma once
/// Subworld: a few moving cells cut out of a world, with their neighbours constrained. Division,
/// sleep and change of model step subworlds and write the cells back by index.

#include <cstddef>
#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Set of cells: lanes of deformable cells, indices of spheres; ascending.
struct CellSet {
  std::vector<std::size_t> dcm, cbm;
  bool empty() const { return dcm.empty() && cbm.empty(); }
};

/// Lanes of a set of cells among those of all rows of cells.
std::vector<std::size_t> lanes_of(const State& state, const CellSet& cells);

/// Neighbours of a set of cells: the others whose bounding boxes come within `reach`, um. Each
/// process tests the cells whose points it has. Collective.   @pre all have the points of `cells`
CellSet find_neighbours(const World& world, const CellSet& cells, double reach);

struct Subworld {
  World world;  ///< moving cells first
  Workspace work;
  CellSet moving, constrained;  ///< cells of the whole world
  /// Lanes in the subworld, [moving.dcm] and [constrained.dcm].
  std::vector<std::size_t> lane, constrained_lane;
};

/// Gives a subworld the parameters of a world and its processes.
void take_params(const World& world, Subworld& sub);

/// Copies cells with clock and references into a subworld whose parameters are set. Its workspace
/// is kept while the set of cells is the same.
void take_cells(const State& state, CellSet moving, CellSet constrained, Subworld& sub);

/// Extracts a subworld at rest: reference volumes and walls are frozen at the present time, no cell
/// is motile, and the clock starts with short steps.
void extract_at_rest(const World& world, CellSet moving, CellSet constrained, Subworld& sub);

/// Outcome of settling a subworld.
struct Settling {
  bool ok = true;
  std::string cause;
  int steps = 0;
};

/// Advances the subworld for a duration, s.
Settling relax(Subworld& sub, double duration);

/// Writes positions of the moving cells and contacts of moving spheres back to the whole world.
void write_positions(const Subworld& sub, State& state);

/// Writes last moves of the moving cells, times `ratio`, back to the whole world.
void write_last_moves(const Subworld& sub, double ratio, State& state);

/// Writes positions and last moves back; the moves are scaled to the length of the last step of the
/// whole world.
void write_moved(const Subworld& sub, State& state);

}  // namespace acinus::coupling
