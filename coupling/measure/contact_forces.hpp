#pragma once
/// Individual contacts of an assembled state: partners, forces and points of action.

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

inline constexpr std::size_t kNoCell = std::numeric_limits<std::size_t>::max();

/// Contact of a cell with another, with itself (a fold) or with boundary. Cells are numbered in the
/// order of measure_cells.
struct ContactForce {
  std::size_t a = 0;
  std::size_t b = kNoCell;                           ///< kNoCell: boundary
  contact::Partner kind = contact::Partner::kPlane;  ///< of the boundary
  int index = 0;                                     ///< within its kind
  Vec3 force = Vec3::Zero();                         ///< nN, on a; the opposite on its partner
  Vec3 normal = Vec3::Zero();  ///< unit, toward a: force . normal > 0 in compression
  Vec3 arm_a = Vec3::Zero();   ///< um, from the centre of a to the point of action
  Vec3 arm_b = Vec3::Zero();   ///< um, the same of b
  double area = 0;             ///< um^2, contact area with boundary
  /// True for two cells that exert a force on each other; false for folds.
  bool touching = false;
  const contact::Contact* record = nullptr;  ///< null: a fading force
  /// True for the fading force left by a change of model. With boundary its normal and kind are
  /// unknown.
  bool fades = false;
};

/// Centres of all cells in the order of measure_cells, um; zero for cells without points here.
std::vector<Vec3> list_centers(const World& world, const Workspace& work);

/// Calls `visit` with every contact, then with every fading pair force (fading.hpp).   @pre observe
void visit_contacts(const World& world, const Workspace& work,
                    const std::function<void(const ContactForce&)>& visit);

/// Contact force of cells on one part of the boundary, without friction, which depends on
/// velocities.
struct Reaction {
  Vec3 net = Vec3::Zero();  ///< nN, sum of the forces on the boundary
  double normal = 0;        ///< nN, sum of normal forces, positive in compression
  double area = 0;          ///< um^2, contact area
  Reaction& operator+=(const Reaction& other) {
    net += other.net;
    normal += other.normal;
    area += other.area;
    return *this;
  }
};

/// Reactions of every obstacle, in the order of Boundary, and of each segment of vessels.
struct Reactions {
  std::array<std::vector<Reaction>, contact::kObstacleKinds> part;  ///< [kind][index]
  const std::vector<Reaction>& of(contact::Partner kind) const {
    return part[static_cast<std::size_t>(kind)];
  }
};
Reactions compute_reactions(const World& world, const Workspace& work);

/// Imbalance of action and reaction of the DCM-CBM contacts, with forces distributed over nodes and
/// spheres as in the solver: the larger of |sum f| / sum |f| and, about their centroid, |sum x f| /
/// sum |x||f|; 0 without contacts.   @pre observe
double interface_residual(const World& world, const Workspace& work);

}  // namespace acinus::coupling
