#pragma once
/// Rigid closed triangle meshes as obstacles.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "contact/material.hpp"
#include "contact/surface.hpp"
#include "geometry/surface.hpp"

namespace acinus::contact {

/// Rigid closed triangle mesh as an obstacle, made by make_static_mesh.
struct StaticMesh {
  std::string name;
  /// Owners: the boundaries of a world and of its copies, whose bodies point at it.
  std::shared_ptr<const std::vector<std::array<int, 3>>> triangle;
  SurfaceBody body;
  bool inside = false;  ///< cells are inside: triangles are stored facing inward
  Material material;
};

/// Static mesh from a closed surface.
/// @param surface  closed, outward
/// @param inside   true if cells are inside it
StaticMesh make_static_mesh(std::string name, geometry::Surface surface, bool inside);

}  // namespace acinus::contact
