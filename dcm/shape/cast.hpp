#pragma once
/// Fresh meshes for star-shaped bodies (geometry/star.hpp): the nodes of a sphere mesh are cast
/// from an inner point onto the surface, then spread evenly over it.

#include <optional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/star.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Parts of the mesh of a newborn daughter cell.
enum class Part : char {
  kCap,   ///< inside the cut face
  kRim,   ///< on the edge of the cut face
  kShell  ///< on the mother's surface
};

/// Nodes of a sphere mesh cast along their rest directions, turned by `rotation`, from `center`
/// onto a closed surface. No face is inverted and no two cross. Empty when the surface is not
/// star-shaped from the centre.
std::optional<std::vector<Vec3>> cast_sphere(const geometry::Topology& topology,
                                             const geometry::Surface& surface, const Vec3& center,
                                             const Mat3& rotation = Mat3::Identity());

/// True if every face is seen from its inner side: with the topology of a sphere, a surface without
/// folds that does not cross itself.
bool faces_outward(const geometry::Topology& topology, std::span<const Vec3> node,
                   const Vec3& center);

/// Constraints on the nodes of a mesh while they are spread.
struct SpreadRule {
  std::span<const Part> part;  ///< [n_node] rim nodes stay, cap nodes follow their neighbours
                               ///< without being cast, shell nodes keep on the surface
  int n_shell_face = 0;        ///< shell nodes only go to the first faces of the surface
};

/// Spreads the nodes of a mesh around a star-shaped surface. Each sweep moves every free node
/// towards the centroid of the triangles around it and, on the surface, along the gradient of the
/// volume: nodes move to ridges, so that chords cut off less. Moves that fold a triangle or spoil a
/// good one are rejected.
/// @param node  [n_node] um, shell nodes on the surface; in and out. @pre faces_outward
void spread_nodes(const geometry::Topology& topology, const geometry::StarSurface& star,
                  const SpreadRule& rule, std::span<Vec3> node);

/// Fresh mesh of a surface that is star-shaped from the centre, cast and spread; empty if it is
/// not.
std::optional<std::vector<Vec3>> cast_and_spread(const geometry::Topology& topology,
                                                 const geometry::Surface& surface,
                                                 const Vec3& center, const Mat3& rotation);

}  // namespace acinus::dcm
