#pragma once
/// Checks that a triangle surface is the closed, oriented boundary of a body.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Half-edge: one side of one triangle.
struct HalfEdge {
  int low = 0, high = 0;  ///< nodes, low < high
  int triangle = 0;
  int opposite = 0;      ///< third node of the triangle
  bool forward = false;  ///< the triangle runs low -> high
};

/// Half-edges of all triangles, sorted by (low, high), forward first: on a closed oriented manifold
/// entries 2e and 2e+1 are the two sides of edge e. Cost n log n.
std::vector<HalfEdge> make_half_edges(std::span<const std::array<int, 3>> triangle);

/// Throws Error unless every edge joins exactly two triangles that run along it in opposite
/// directions, and the triangles round each node form one fan. `where` begins the message, which
/// counts the bad edges and gives the first with its coordinates. Nodes of no triangle are allowed.
void check_manifold(const Surface& surface, const std::string& where);

/// Throws as check_manifold, and if the surface encloses no volume; turns a surface that points
/// inward everywhere outward. @param where  for instance "embryo.vtk: body 3"
void check_closed(Surface& surface, const std::string& where);

}  // namespace acinus::geometry
