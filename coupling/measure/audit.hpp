#pragma once
/// Independent audit of the overlaps in every written frame: exact inside tests and distances on
/// the triangles. It shares no code with the contact search, which ends at its depth limit and
/// would miss a cell that has tunnelled through another.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/vec.hpp"
#include "coupling/measure/audit_frame.hpp"
#include "geometry/audit_body.hpp"

namespace acinus::coupling {

/// Prepares a static closed mesh. The spans must outlive the result. Throws Error if a coordinate
/// is not finite or the mesh is not closed.
/// @param triangle  outward
/// @param what      name in messages
geometry::AuditBody prepare_static_mesh(std::span<const Vec3> node,
                                        std::span<const std::array<int, 3>> triangle,
                                        const std::string& what);

struct WorstPair {
  double depth_um = 0;
  std::vector<std::int64_t> ids;  ///< both partners, empty without overlap
  std::size_t number = 0;         ///< of the first partner among all cells
};

struct AuditResult {
  /// Largest of dcm_dcm, dcm_vessel, dcm_wall and dcm_cbm_beyond_indentation. A soft sphere is
  /// indented by a cell, as two spheres overlap by their law; only larger depths count
  /// (decision 9).
  double max_penetration_um = 0;
  /// max_penetration_um without pairs that have a newborn cell.
  double max_penetration_grown_um = 0;
  WorstPair dcm_dcm;     ///< ids of the cells
  WorstPair dcm_vessel;  ///< cell id, vessel segment
  WorstPair dcm_wall;    ///< cell id, index counted through walls, then static meshes
  WorstPair dcm_cbm;     ///< mesh cell id, sphere id: geometric depth in the round sphere
  WorstPair
      dcm_cbm_beyond_indentation;  ///< the same minus the indentation that their force explains
  double max_overlap_cbm_um = 0;   ///< max of Ri + Rj - distance over spheres
  WorstPair cbm_cbm;               ///< sphere ids
  WorstPair cbm_vessel;            ///< sphere id, vessel segment
  WorstPair cbm_wall;              ///< sphere id, index as of dcm_wall
  WorstPair center_in_static;      ///< sphere id, static: depth of its centre on the forbidden side
  double min_triangle_quality =
      1;  ///< 4 sqrt(3) area / sum of squared edges: 1 equilateral, 0 flat
  std::int64_t worst_triangle_cell = -1;
  std::size_t worst_triangle_number = 0;  ///< of that cell among all
  int n_inverted = 0;                     ///< cells of non-positive volume
  int n_self_intersecting = 0;            ///< cells with intersecting triangles
};

/// Audits a frame. Depths, um, by kind of partner:
/// - cell in cell or closed mesh: distance to the surface of the other over nodes, edge midpoints
///   and triangle centroids strictly inside it, both ways. Edges that pass through without a sample
///   inside count with the depth along the part inside. A volume centroid inside both counts with
///   the smaller of its two depths, which detects coinciding cells. Inside = parity of ray
///   crossings with exact predicates.
/// - cell in vessel: depth of its surface in the round cone (the balls along the axis); radius +
///   distance to the surface of the cell where the axis runs inside the cell.
/// - cell or sphere at the surface of vessels: as with a closed mesh.
/// - cell behind a wall: depth of the farthest node.
/// - two spheres: Ri + Rj - distance. Sisters deeper in each other than to the centre count only at
///   full strength of their forces and nearer than at birth, since until then they separate.
/// - sphere in vessel, wall or closed mesh: radius minus the distance of the centre from the
///   surface. Spheres overlap there by their law: reported, but not a penetration.
/// - cell and sphere: radius - distance to the surface of the cell, or radius + distance with the
///   centre inside.
///
/// Touching is not overlap. Cost n log n in the number of bodies; pairs run in parallel. Each
/// process audits the pairs whose first cell is its own, and all get the worst of all: the result
/// does not depend on the number of threads and processes. Collective. Throws Error if a coordinate
/// is not finite or a static is not closed.
AuditResult audit(const AuditFrame& frame, const Ranks& ranks = Ranks::serial());

}  // namespace acinus::coupling
