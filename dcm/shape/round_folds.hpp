#pragma once
/// Rounding of folds that are sharper than the shell of the mesh can bend.

#include <span>

#include "core/vec.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Radius of curvature across an edge, um: the distance between the centroids of its triangles
/// along the surface over the angle between their normals. Infinite where it is flat.
double fold_radius(const geometry::Topology& topology, std::span<const Vec3> node, int edge);

/// Moves the nodes of folds with a smaller radius than this towards their neighbours until none is
/// left, or as far as some sweeps bring them. A coarse mesh, whose edges are longer than the
/// radius, hardly has such folds: its nodes stay where they are.
void round_folds(const geometry::Topology& topology, double least_radius, std::span<Vec3> node);

}  // namespace acinus::dcm
