#pragma once
/// Ghost cells of a step: cells computed by other processes. Every process knows all positions;
/// results that depend on all contacts of a cell are known to its owner and exchanged here.

#include <cstddef>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "coupling/world/workspace.hpp"

namespace acinus::coupling {

/// Marks ghost cells for the contact search.   @pre the blocks of the system are set
void mark_ghost_cells(const World& world, Workspace& work);

/// Owner of a cell; lanes count [dcm lanes, then cbm cells].
/// @pre the work is shared: the ownership is not whole
int owner_of_lane(const Workspace& work, std::size_t lane);

/// Exchanges the touching shares of the points of ghost bodies in contact with own cells.
/// @pre all contacts of deformable cells are found
void exchange_shares(Workspace& work);

/// Exchange plan of sphere values between neighbouring processes.
struct SphereExchange {
  ExchangePlan plan;
  std::vector<int> send, receive;
};
/// Derives the plan from the neighbour lists.
/// @pre neighbour lists of spheres and of the interface are current
SphereExchange plan_sphere_exchange(const Workspace& work);

/// Exchanges the values of ghost spheres next to own cells.
/// @param value  [n_cell], or empty
void exchange_values(const Workspace& work, const SphereExchange& spheres,
                     std::vector<double>& value);

}  // namespace acinus::coupling
