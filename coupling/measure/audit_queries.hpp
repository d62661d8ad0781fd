#pragma once
/// Queries of the audit about deformable cells, answered in the order of a sweep, so that few
/// bodies with search trees exist at a time.

#include <cstddef>
#include <span>
#include <vector>

#include "coupling/measure/audit_depth.hpp"
#include "coupling/measure/audit_frame.hpp"

namespace acinus::coupling {

/// Partner of a cell in a query.
enum class AuditPartner {
  kNone,  ///< volume, mesh quality and self-intersection of the cell
  kCell,
  kSphere,
  kCone,           ///< a vessel segment
  kFixed,          ///< a static mesh with cells outside
  kEnvelope,       ///< a static mesh with cells inside
  kVesselSurface,  ///< the surface of the vessels
};

/// Query about cell `a` of a frame, with body `b` of the kind of the partner.
struct AuditQuery {
  AuditPartner partner = AuditPartner::kNone;
  std::size_t a = 0, b = 0;
};

struct AuditAnswer {
  double depth = 0;                ///< um, of queries about two bodies
  double volume = 0, quality = 1;  ///< of queries about one: um^3, smallest triangle quality
  bool self_intersects = false;    ///< likewise
};

/// Answers queries, distributed over the threads.
/// @param box   [mesh] boxes of the cells
/// @param cone  vessel segments
std::vector<AuditAnswer> answer_queries(const AuditFrame& frame, std::span<const Box> box,
                                        std::span<const RoundCone> cone,
                                        std::span<const AuditQuery> query);

}  // namespace acinus::coupling
