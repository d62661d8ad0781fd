#pragma once
/// Nuclei of cells whose cortex is new: of daughters, and of cells with a mended mesh. Pure
/// geometry: no state is touched.

#include <span>
#include <vector>

#include "core/vec.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// A round nucleus in the largest ball within a cortex, smaller than at rest where that leaves no
/// room, and turned so that its links run outward.
/// @param node    [n_node] um, of the cortex
/// @param radius  um, of the nucleus at rest
/// @param gap     um, that it keeps from the cortex if it can
std::vector<Vec3> place_nucleus(const Group& group, std::span<const Vec3> node, double radius,
                                double gap);

/// The mesh of a nucleus turned on its own surface as a new mesh of the cortex is turned, so that
/// its links run outward again; empty where that surface hides part of itself from its centre.
/// @param old  [n_node of the nucleus] um
std::vector<Vec3> turn_nucleus(const Group& group, std::span<const Vec3> node,
                               std::span<const Vec3> old);

/// Lengths of the links over those at rest in a sphere, [n_node of the nucleus].
/// @param radius  um, reference radius of the cell
std::vector<double> link_ratios(const Group& group, double radius, std::span<const Vec3> node,
                                std::span<const Vec3> nucleus);

}  // namespace acinus::dcm
