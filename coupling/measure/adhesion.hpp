#pragma once
/// Adhesion between deformable cells.

#include <cstdint>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Contact region of deformable cells. Points within the range of the cohesive potential of another
/// cell belong to it, in attraction or repulsion. With the law of Maugis-Dugdale it consists of the
/// triangles with a contact force.
struct Adhesion {
  double area = 0;  ///< um^2 of the reference surfaces, half from either side;
                    ///< Maugis-Dugdale: of the contact planes
  /// [nodes of the deformable cells, body by body] 1: part of a point in contact
  std::vector<std::uint8_t> node;
};
Adhesion measure_adhesion(const World& world, const Workspace& work);  ///< @pre observe

/// Surface tensions in and out of contact, nN/um: means over nodes, and the least in contact; NaN
/// without nodes.
struct ContactTensions {
  double outside = 0, contact = 0, least = 0;
};
/// Computes tensions in and out of contact.
/// @param tension  [nodes] nN/um, of measure_nodes
ContactTensions compute_contact_tensions(const std::vector<double>& tension,
                                         const Adhesion& adhesion);

/// True if any two deformable cells adhere or press in the contacts searched last.
bool any_adhesion(const World& world, const Workspace& work);

}  // namespace acinus::coupling
