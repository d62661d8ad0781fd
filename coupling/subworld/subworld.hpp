#pragma once
/// A small world cut out of a large one: a few cells that move, and their neighbours constrained.
/// Division, sleep and change of model step such worlds and write the cells back by index.

#include <cstddef>
#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Some cells of a world: lanes of deformable cells, indices of spheres. Ascending.
struct CellSet {
  std::vector<std::size_t> dcm, cbm;
  bool empty() const { return dcm.empty() && cbm.empty(); }
};

/// Cells of the other bodies whose boxes come within `reach` of these, um.
CellSet find_neighbours(const World& world, const CellSet& cells, double reach);

struct Subworld {
  World world;  ///< moving cells first
  Workspace work;
  CellSet moving, constrained;    ///< cells of the large world
  std::vector<std::size_t> lane;  ///< [moving.dcm] where they stand here
};

/// Copies the cells as they are, with clock and references, into a subworld whose parameters are
/// set; its workspace lives on while the same cells are in it.
void take_cells(const State& state, CellSet moving, CellSet constrained, Subworld& sub);

/// A subworld in which nothing moves by itself: reference volumes and walls stay what they are at
/// this moment, no cell is motile, and its clock starts short steps.
void extract_at_rest(const World& world, CellSet moving, CellSet constrained, Subworld& sub);

/// How a subworld came to rest.
struct Settling {
  bool ok = true;
  std::string cause;
  int steps = 0;
};

/// Steps the subworld for some time, s.
Settling relax(Subworld& sub, double duration);

/// Writes positions of the moving cells back, and the contacts of moving spheres.
void write_positions(const Subworld& sub, State& state);

/// Writes last moves of the moving cells back, times `ratio`.
void write_last_moves(const Subworld& sub, double ratio, State& state);

/// Writes positions and last moves back; these as far as a last step of the other length went.
void write_moved(const Subworld& sub, State& state);

}  // namespace acinus::coupling
