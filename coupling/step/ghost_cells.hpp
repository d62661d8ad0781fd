#pragma once
/// What a step has to know of cells that other processes work out. Positions of all cells are known
/// everywhere; what follows from all contacts of a cell is known to its owner.

#include <cstddef>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Tells the contact search which cells are not own. @pre the blocks of the system are set
void mark_ghost_cells(const World& world, Workspace& work);

/// The process that works out a cell; lanes count [dcm lanes, then cbm cells].
/// @pre the work is shared: the ownership is not whole
int owner_of_lane(const Workspace& work, std::size_t lane);

/// Gets the touching shares of the points of ghost bodies that own cells are in contact with.
/// @pre all contacts of deformable cells are found
void exchange_shares(Workspace& work);

/// Spheres whose values neighbours on other processes need.
struct SphereExchange {
  ExchangePlan plan;
  std::vector<int> send, receive;
};
/// @pre near pairs of spheres, and of spheres with deformable cells, are listed
SphereExchange plan_sphere_exchange(const Workspace& work);

/// Gets the values of ghost spheres next to own cells. @param value [n_cell], or empty
void exchange_values(const Workspace& work, const SphereExchange& spheres,
                     std::vector<double>& value);

}  // namespace acinus::coupling
