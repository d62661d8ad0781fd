#pragma once
/// Nuclei of cells with a new cortex: of daughters, and of cells with a mended mesh. Pure geometry:
/// no state is changed.

#include <span>
#include <vector>

#include "core/vec.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// Round nucleus in the largest ball within a cortex, smaller than at rest if that ball is too
/// small, and turned so that its links run outward.
/// @param node    [n_node] um, of the cortex
/// @param radius  um, of the nucleus at rest
/// @param gap     um, distance kept from the cortex where possible
std::vector<Vec3> place_nucleus(const Group& group, std::span<const Vec3> node, double radius,
                                double gap);

/// Mesh of a nucleus turned on its own surface like a new mesh of the cortex, so that its links run
/// outward again; empty where that surface is not star-shaped from its centre.
/// @param old  [n_node of the nucleus] um
std::vector<Vec3> turn_nucleus(const Group& group, std::span<const Vec3> node,
                               std::span<const Vec3> old);

/// Lengths of the links over those at rest in a sphere, [n_node of the nucleus].
/// @param radius  um, reference radius of the cell
std::vector<double> link_ratios(const Group& group, double radius, std::span<const Vec3> node,
                                std::span<const Vec3> nucleus);

}  // namespace acinus::dcm
