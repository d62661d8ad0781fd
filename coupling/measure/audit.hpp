#pragma once
/// How deep do bodies really overlap? An independent check of every written frame: exact inside
/// tests and distances on the triangles themselves. It shares no code with the contact search,
/// which is blind past its depth limit and would not see a cell that has tunnelled through another.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/vec.hpp"
#include "coupling/measure/audit_walls.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/network.hpp"

namespace acinus::coupling {

struct AuditMesh {
  std::int64_t id = 0;
  std::span<const Vec3> node;                    ///< um
  std::span<const std::array<int, 3>> triangle;  ///< closed, outward
  bool newborn = false;                          ///< just born and still settling
};
struct AuditSphere {
  std::int64_t id = 0;
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double strength = 1;       ///< of a new sphere, see cbm::CellData
  std::int64_t mother = -1;  ///< sisters start in one place; -1: there from the start
};
/// How deep a sphere is known to be indented by a cell, from the force between them.
struct KnownIndentation {
  std::int64_t mesh_id = 0, sphere_id = 0;
  double depth = 0;  ///< um
};
/// A closed mesh that does not move. @param triangle  outward  @param what  it is, for messages
/// The spans must outlive what comes back. Throws Error if a coordinate is not finite or it is not
/// closed.
geometry::AuditBody prepare_static(std::span<const Vec3> node,
                                   std::span<const std::array<int, 3>> triangle,
                                   const std::string& what);
struct AuditStatic {
  geometry::AuditBody body;  ///< of prepare_static, once for all frames of a run: it takes long
  bool inside = false;       ///< cells live inside it
};

/// Everything in one frame. Spans may be empty; they must outlive the call.
struct AuditFrame {
  std::span<const AuditMesh> meshes;
  std::span<const AuditSphere> spheres;
  std::span<const KnownIndentation> indentations;  ///< pairs not listed are taken as not indented
  const geometry::Network* vessels = nullptr;
  /// The surface of the vessels, of prepare_static, where cells meet that; cones then only name the
  /// nearest segment.
  const geometry::AuditBody* vessel_surface = nullptr;
  std::span<const AuditWall> walls;
  std::span<const AuditStatic> statics;
};

struct WorstPair {
  double depth_um = 0;
  std::vector<std::int64_t> ids;  ///< the two partners, empty if nothing overlaps
};

struct AuditResult {
  /// Largest of dcm_dcm, dcm_vessel, dcm_wall and dcm_cbm_beyond_indentation. A soft sphere yields
  /// where a cell presses on it, as two spheres overlap by their law; only what goes deeper counts
  /// (docs/decisions/0009.md).
  double max_penetration_um = 0;
  /// The same without the pairs in which a cell is newborn.
  double max_penetration_grown_um = 0;
  WorstPair dcm_dcm;     ///< ids of the cells
  WorstPair dcm_vessel;  ///< cell id, vessel segment
  WorstPair dcm_wall;    ///< cell id, index counted through walls, then statics
  WorstPair dcm_cbm;     ///< mesh cell id, sphere id: geometric depth in the round sphere
  WorstPair
      dcm_cbm_beyond_indentation;  ///< the same, less the indentation the pair's force explains
  double max_overlap_cbm_um = 0;   ///< max of Ri + Rj - distance over spheres
  WorstPair cbm_cbm;               ///< sphere ids
  WorstPair cbm_vessel;            ///< sphere id, vessel segment
  WorstPair cbm_wall;              ///< sphere id, index as of dcm_wall
  WorstPair center_in_static;      ///< sphere id, static: how far its centre is where none may be
  double min_triangle_quality =
      1;  ///< 4 sqrt(3) area / sum of squared edges: 1 equilateral, 0 flat
  std::int64_t worst_triangle_cell = -1;
  int n_inverted = 0;           ///< cells of non-positive volume
  int n_self_intersecting = 0;  ///< cells with two triangles that cross
};

/// Depths (um) by kind of partner:
/// - cell in cell or closed mesh: over nodes, edge midpoints and triangle centroids of one strictly
///   inside the other, the distance to the other's surface, both ways; edges that pass through
///   without leaving a sample inside count with the depth along the part inside; a volume centroid
///   inside both counts with the smaller of its two depths, so coinciding cells are seen. Inside =
///   parity of ray crossings with exact predicates.
/// - cell in vessel: depth of its surface in the round cone (the balls along the axis); where the
/// axis
///   itself runs inside the cell, radius + distance to the cell's surface.
/// - cell or sphere at the surface of vessels: as with a closed mesh.
/// - cell behind a wall: the farthest node.
/// - two spheres: Ri + Rj - distance. Sisters deeper in each other than to the centre count only
/// when
///   their forces have full strength and they are nearer than at birth: until then they come apart.
/// - sphere in vessel, wall or closed mesh: radius less the centre's distance from the
/// surface. By their law spheres yield there: it is told and no penetration.
/// - cell and sphere: radius - distance to the cell's surface, or radius + distance if the centre
/// is inside. Touching is not overlap. Cost n log n in the number of bodies; pairs run in parallel,
/// and the result does not depend on the number of threads. Throws Error if a coordinate is not
/// finite or a static is not closed.
AuditResult audit(const AuditFrame& frame, const Ranks& ranks = Ranks::serial());

}  // namespace acinus::coupling
