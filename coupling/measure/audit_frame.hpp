#pragma once
/// Input of the audit: the bodies of a frame.

#include <array>
#include <cstdint>
#include <span>

#include "core/vec.hpp"
#include "coupling/measure/audit_walls.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/network.hpp"

namespace acinus::coupling {

struct AuditMesh {
  std::int64_t id = 0;
  std::span<const Vec3> node;                    ///< um
  std::span<const std::array<int, 3>> triangle;  ///< closed, outward
  bool newborn = false;                          ///< true while settling after birth
  bool own = true;         ///< false: another process audits it, if it comes first of a pair
  std::size_t number = 0;  ///< among all cells; of equal depths that of the first cell counts
};
struct AuditSphere {
  std::int64_t id = 0;
  Vec3 center = Vec3::Zero();
  double radius = 0;
  double strength = 1;       ///< strength of its forces, see cbm::CellData
  std::int64_t mother = -1;  ///< lineage; sisters start overlapped; -1: initial cell
  bool own = true;           ///< as of AuditMesh
  std::size_t number = 0;    ///< likewise
};
/// Indentation of a sphere by a cell that their force explains.
struct KnownIndentation {
  std::int64_t mesh_id = 0, sphere_id = 0;
  double depth = 0;  ///< um
};
struct AuditStaticMesh {
  geometry::AuditBody body;  ///< of prepare_static_mesh (audit.hpp), expensive, once per run
  bool inside = false;       ///< true: cells are inside it
};

/// Contents of a frame: own bodies, and those of others that may touch them. Both are in the order
/// of their numbers. Spans may be empty; they must outlive the call.
struct AuditFrame {
  std::span<const AuditMesh> meshes;
  std::span<const AuditSphere> spheres;
  std::span<const KnownIndentation> indentations;  ///< pairs not listed have none
  const geometry::Network* vessels = nullptr;
  /// Surface of the vessels, of prepare_static_mesh, if cells touch it; the segments then only name
  /// the nearest one.
  const geometry::AuditBody* vessel_surface = nullptr;
  std::span<const AuditWall> walls;
  std::span<const AuditStaticMesh> static_meshes;
};

}  // namespace acinus::coupling
