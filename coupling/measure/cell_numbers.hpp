#pragma once
/// Numbers of cells in measures: deformable ones by lane, then spheres. They are the same on every
/// process, whichever bodies it has.

#include <cstddef>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct CellNumbers {
  std::vector<std::size_t> lane;     ///< [deformable cell] its lane
  std::vector<std::size_t> of_body;  ///< [body] number of its cell

  std::size_t of_sphere(std::size_t cell) const { return lane.size() + cell; }
};
/// @pre the bodies of `work` are those of the state
CellNumbers number_cells(const State& state, const Workspace& work);

/// Process that measures a cell.   @pre the work is shared: the ownership is not whole
int owner_of_number(const CellNumbers& numbers, const Workspace& work, std::size_t cell);

/// True for an own cell: all are without other processes, or if each does all work.
bool is_own_number(const CellNumbers& numbers, const Workspace& work, std::size_t cell);

}  // namespace acinus::coupling
