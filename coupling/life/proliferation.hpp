#pragma once
/// Which resting cells enter the cycle, by their layer from the edge of the lesion and by time.
/// [VanLiedekerke2020, section 3.3: an imposed spatio-temporal pattern]

#include <span>

#include "coupling/world/cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Layer of a cell, counted from 1 at the edge of the lesion.
/// @param distance  of its centre from the vein axis, um
/// @param edge      of the innermost centres, um
int layer_of(double distance, double edge, double thickness);

/// That of a place by the rule's axis and thickness.
int layer_of(const Proliferation& rule, double edge, const Vec3& place);

/// Distance of the lesion's edge from the vein axis, um: as it was made (edge_at_start) or the mean
/// over slices of height one layer high of the distance to the nearest centre.
double lesion_edge(const World& world);

/// Lets resting cells enter the cycle with the rate of their layer, over one interval of the life
/// grid. Cells are asked in the order of their numbers; none enters once as many cells as wanted
/// are there or on their way.
/// @param factor  [dcm lanes, then cbm cells] of growth_factor; scales the rate
void let_proliferate(World& world, std::span<const double> factor);

}  // namespace acinus::coupling
