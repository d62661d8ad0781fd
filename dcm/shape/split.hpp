#pragma once
/// Geometry of cell division: the meshes of two daughter cells that fill their mother.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "dcm/shape/cast.hpp"
#include "geometry/cut.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Moves each node by the same multiple of its own direction until the mesh encloses
/// `target_volume`, um^3, within 1e-12 of it: the volume is a cubic of that multiple. Returns the
/// multiple; nothing, and nodes as they were, if Newton's method finds none within a tenth of the
/// volume radius. @param direction  [n_node]
std::optional<double> match_volume_along(const geometry::Topology& topology, double target_volume,
                                         std::span<const Vec3> direction, std::span<Vec3> node);

/// Moves nodes along their normals (area-weighted, length 1) times `weight` [n_node] to a volume,
/// like match_volume_along; a weight of zero keeps a node in place.
bool match_volume(const geometry::Topology& topology, double target_volume,
                  std::span<const double> weight, std::span<Vec3> node);

/// Shapes below (0) and above (1) the plane; both meshes have the mother's topology and
/// volume_mother / 2.
struct DaughterShapes {
  geometry::CutPlane plane;
  std::vector<Vec3> rim;   ///< intersection of the plane with the mother's surface, in order
  std::vector<Part> part;  ///< [n_node] of both; cap and rim nodes lie in the plane or are rounded
  std::array<std::vector<Vec3>, 2> node;  ///< um; the rims of both have the same points
  /// Part of the half's volume that chords cut off, before the nodes were moved out to regain it.
  std::array<double, 2> chord_loss{};
  std::array<double, 2> outset{};  ///< um; distance of rim and shell nodes outside the mother
};

enum class SplitFailure {
  kNone,
  kNoHalving,      ///< no plane of this direction halves the mother's volume, or it has none
  kSeveralLoops,   ///< the cut is not one closed curve: try another direction
  kNotStarShaped,  ///< a half hides part of its surface from every inner point, or its mesh folds
  kNoVolume        ///< the nodes could not be moved to the right volume without folds
};

struct Split {
  std::optional<DaughterShapes> daughters;
  SplitFailure failure = SplitFailure::kNone;
};

/// Halves a cell by the plane with this unit normal. Cap nodes lie in the plane, rim nodes on the
/// mother's outline in it, shell nodes on her surface; then rim (within the plane) and shell move
/// out by one distance so that both daughters have exactly half her volume. Pure geometry: no state
/// is touched. Throws Error for a topology that is not an icosphere.
/// @param node       [n_node] um, of the mother: a closed outward surface that does not cross
/// itself
/// @param thickness  um, of the cortex: a rim sharper than a shell so thick can be bent is rounded,
///                   and a little of the plane's edge is lost
/// @param turn       rotation of both meshes about the normal, as part of the rim's length
Split split_cell(const geometry::Topology& topology, std::span<const Vec3> node, const Vec3& normal,
                 double thickness = 0, double turn = 0);

}  // namespace acinus::dcm
