#pragma once
/// Entry of quiescent cells into the cycle, by layer from the edge of the lesion and by time.
/// [VanLiedekerke2020, section 3.3: an imposed spatio-temporal pattern]

#include <span>

#include "coupling/world/cell.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Layer of a cell, from 1 at the edge of the lesion.
/// @param distance  of its centre from the vein axis, um
/// @param edge      of the innermost centres, um
int layer_of(double distance, double edge, double thickness);

/// Layer of a position, with the axis and thickness of the rule.
int layer_of(const Proliferation& rule, double edge, const Vec3& place);

/// Distance of the edge of the lesion from the vein axis, um: the initial one (edge_at_start), or
/// the mean over slices one layer high of the smallest distance of a centre.
double lesion_edge(const World& world);

/// Draws the quiescent cells that enter the cycle at the rate of their layer, over one interval of
/// the life grid. Cells are drawn in order of lineage; none enters once the target number exists or
/// is due.
/// @param factor  [dcm lanes, then cbm cells] of growth_factor; scales the rate
void let_proliferate(World& world, std::span<const double> factor);

}  // namespace acinus::coupling
