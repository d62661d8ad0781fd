#pragma once
/// Where deformable cells adhere to each other.

#include <cstdint>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// The contact of deformable cells with each other. A point is in it while it is within the range
/// of the cohesive potential of another cell, whether it attracts or presses there; with the law of
/// Maugis-Dugdale triangles are, where they push or pull.
struct Adhesion {
  double area = 0;  ///< um^2 of the reference surfaces, half of it from either side;
                    ///< Maugis-Dugdale: of the contact planes
  /// [nodes of the deformable cells, body by body] 1: part of a point in contact.
  std::vector<std::uint8_t> node;
};
Adhesion measure_adhesion(const World& world, const Workspace& work);  ///< @pre observe

/// Tensions of the surfaces in and out of contact, nN/um: means over nodes, and the least in
/// contact; NaN where there is no such node.
struct ContactTensions {
  double outside = 0, contact = 0, least = 0;
};
/// @param tension  [nodes] nN/um, of measure_nodes
ContactTensions compute_contact_tensions(const std::vector<double>& tension,
                                         const Adhesion& adhesion);

/// Whether any two deformable cells adhere or press, at the contacts that were searched last.
bool any_adhesion(const World& world, const Workspace& work);

}  // namespace acinus::coupling
