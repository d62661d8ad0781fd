#pragma once
/// The contacts of an assembled state one by one: what presses on what, how hard and where.

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

inline constexpr std::size_t kNoCell = std::numeric_limits<std::size_t>::max();

/// A contact of a cell with another, with itself (a fold) or with boundary. Cells are numbered
/// as measure_cells lists them.
struct ContactForce {
  std::size_t a = 0;
  std::size_t b = kNoCell;                           ///< kNoCell: boundary
  contact::Partner kind = contact::Partner::kPlane;  ///< of the boundary
  int index = 0;                                     ///< within its kind
  Vec3 force = Vec3::Zero();   ///< nN, on a; what it touches gets the opposite
  Vec3 normal = Vec3::Zero();  ///< unit, toward a: force . normal > 0 where they press
  Vec3 arm_a = Vec3::Zero();   ///< um, from the centre of a to where the force acts
  Vec3 arm_b = Vec3::Zero();   ///< um, the same of b
  double area = 0;             ///< um^2 in touch, of contacts with boundary
  /// Two cells that exert a force on each other; never of a fold.
  bool touching = false;
  /// No contact, but what a pair is left with by a change of model; with boundary the normal and
  /// the kind are not known.
  bool fades = false;
};

/// Calls `look` with every contact, then with every pair force that fades (fading.hpp).   @pre
/// observe
void visit_contacts(const World& world, const Workspace& work,
                    const std::function<void(const ContactForce&)>& look);

/// What cells exert on one part of the boundary by pressing and pulling; what they exert by
/// rubbing depends on how fast they move and is left out.
struct Reaction {
  Vec3 net = Vec3::Zero();  ///< nN, sum of the forces on the boundary
  double normal = 0;  ///< nN, sum of their sizes along the normals, positive where cells press
  double area = 0;    ///< um^2 in touch
  Reaction& operator+=(const Reaction& other) {
    net += other.net;
    normal += other.normal;
    area += other.area;
    return *this;
  }
};

/// Of every obstacle, in the order of Boundary; of vessels: of each segment.
struct Reactions {
  std::array<std::vector<Reaction>, contact::kObstacleKinds> part;  ///< [kind][index]
  const std::vector<Reaction>& of(contact::Partner kind) const {
    return part[static_cast<std::size_t>(kind)];
  }
};
Reactions compute_reactions(const World& world, const Workspace& work);

/// Pairs of cells that exert a force on each other, a < b, ascending.   @pre observe
std::vector<std::pair<std::size_t, std::size_t>> find_touching(const World& world,
                                                               const Workspace& work);

/// For each cell the number of cells it hangs together with through contacts, itself included.
std::vector<int> cluster_sizes(std::size_t n_cell,
                               const std::vector<std::pair<std::size_t, std::size_t>>& touching);

/// How far the forces of the DCM-CBM contacts, spread over nodes and spheres as the solver spreads
/// them, are from action and reaction: the larger of |sum f| / sum |f| and, about their centroid,
/// |sum x f| / sum |x||f|. 0 where there are none.   @pre observe
double interface_residual(const World& world, const Workspace& work);

}  // namespace acinus::coupling
