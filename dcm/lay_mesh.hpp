#pragma once
/// A cell's mesh laid over a closed surface.

#include <optional>
#include <vector>

#include "core/mesh/surface.hpp"
#include "core/mesh/topology.hpp"
#include "core/vec.hpp"

namespace acinus::dcm {

/// The nodes of a sphere mesh, spread evenly over a surface, with its volume: chords cut corners
/// off, so the nodes stand a little outside. Nothing where no point sees the surface whole, or the
/// mesh would fold.
/// @param surface   closed, outward
/// @param rotation  of the sphere mesh before
std::optional<std::vector<Vec3>> lay_mesh(const mesh::Topology& topology,
                                          const mesh::Surface& surface, const Mat3& rotation);

}  // namespace acinus::dcm
