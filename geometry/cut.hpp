#pragma once
/// Cut of a closed triangle surface by a plane.
///
/// A node exactly on the plane counts as infinitesimally above it, here and everywhere: no case is
/// special, and triangles of zero area may appear instead.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/measures.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Cutting plane. Points with normal . x < offset are below.
struct CutPlane {
  Vec3 normal = Vec3::UnitZ();  ///< length 1
  double offset = 0;            ///< um
};

/// Volume of a closed surface below the plane, um^3. By Gauss' theorem for the field (normal . x -
/// offset) normal, which vanishes on the plane, so that the cut face adds nothing: V = sum over the
/// parts of triangles below of (mean height) (area projected along the normal). Exact up to
/// round-off, for non-convex surfaces too.
double compute_volume_below(std::span<const Vec3> node, Triangles triangle, const CutPlane& plane);

/// Plane with this unit normal that halves the volume, to 1e-13 of it unless round-off forbids.
/// Newton's method (the derivative of the volume is the area of the cut) inside a bracket. Nothing
/// if the surface encloses no positive volume or the halves differ by more than 1e-10.
std::optional<CutPlane> find_halving_plane(std::span<const Vec3> node, Triangles triangle,
                                           const Vec3& normal);

struct Cut {
  /// Closed curves of the cut, each counter-clockwise seen against the normal where the body lies
  /// inside it; consecutive points may coincide (a node on the plane).
  std::vector<std::vector<Vec3>> loop;
  /// Halves below and above: closed and outward, empty unless there is exactly one loop. The last
  /// loop[0].size() nodes are the loop in its order (the same bits in both halves), the last
  /// loop[0].size() - 2 triangles the cap.
  std::array<Surface, 2> half;
};

/// Cuts a closed oriented surface (closed.hpp; not checked). The cap is triangulated by ear
/// clipping, convex or not. Throws Error if a single loop has more than kMaxPolygon points.
Cut cut_surface(std::span<const Vec3> node, Triangles triangle, const CutPlane& plane);

}  // namespace acinus::geometry
