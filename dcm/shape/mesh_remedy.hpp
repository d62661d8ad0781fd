#pragma once
/// Mesh quality of one cell, and a better mesh on the same surface. Pure geometry: no state is
/// changed.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Measures of mesh quality. Cost: one pass over the triangles.
struct MeshHealth {
  double quality = 1;  ///< worst triangle, 1 equilateral, 0 flat
  double spacing = 1;  ///< shortest edge over the mean reference edge
  double opposed = 1;  ///< smallest n_a . n_b of two faces at an edge: -1 is folded flat
};

/// Thresholds below which a mesh is suspicious. Growing tissue keeps far above: in 2900 cells of
/// spheroids that grew to 700 cells, newborn daughters included, the worst quality was 0.53 and the
/// worst spacing 0.54 (0.50 and 0.48 in a clump that grew four times as fast); in a lobule 0.9 and
/// 0.8. A division accepts daughters of quality 0.1, which must not be mended at once. An edge a
/// tenth as long as the others makes the mesh ten times as stiff there.
inline constexpr double kPoorQuality = 0.1, kPoorSpacing = 0.1;
/// Threshold of `opposed`, a wedge of 26 degrees. Two faces at a sharp rim are opposed too: -0.75
/// in daughters born as lenses.
inline constexpr double kFolded = -0.9;
/// Thresholds of an accepted mesh, higher so that it is not mended again at the next check.
inline constexpr double kGoodQuality = 0.2, kGoodSpacing = 0.15;

/// Quality measures of a mesh. @param radius  um, reference radius (3 V0 / 4 pi)^(1/3)
MeshHealth measure_health(const geometry::Topology& topology, std::span<const Vec3> node,
                          double radius);

inline bool is_suspicious(const MeshHealth& h) {
  return !(h.quality >= kPoorQuality && h.spacing >= kPoorSpacing && h.opposed >= kFolded);
}

/// Distances of a new surface from the old one, um: over nodes, edge midpoints and face centres.
struct SurfaceShift {
  double outside = 0;  ///< new beyond the old surface
  double inside = 0;   ///< new within it
  double lost = 0;     ///< old beyond the new surface
};
/// Distances between two meshes. @param old_node, new_node  [n_node] um, same topology
SurfaceShift compare_surfaces(const geometry::Topology& topology, std::span<const Vec3> old_node,
                              std::span<const Vec3> new_node);

/// Accepted distances of surfaces. Neighbours are outside: contact takes 0.3 um of overlap for the
/// most that ordinary steps make. Inside there is only a gap, which closes by itself; it is
/// measured by the mesh, since the chords of two sound meshes on one surface deviate from each
/// other by a tenth of an edge. A candidate within the finer limit is taken at once; where faces
/// were folded or long, no mesh of good triangles is as close.
struct ShiftLimit {
  double outside;       ///< um
  double inside, lost;  ///< mean reference edges
};
inline constexpr ShiftLimit kFineLimit{0.15, 0.08, 0.11}, kLimit{0.3, 0.16, 0.28};
inline bool is_within(const SurfaceShift& s, const ShiftLimit& limit, double mean_edge) {
  return s.outside <= limit.outside && s.inside <= limit.inside * mean_edge &&
         s.lost <= limit.lost * mean_edge;
}
/// Largest accepted change of the surface area, as a share. A crumpled surface is larger than the
/// one that it approximates.
inline constexpr double kMostAreaChange = 0.1;

struct Mended {
  bool ok = false;
  std::string method;      ///< fresh | relaxed; of the last one tried if not ok
  std::string why;         ///< defect of the last candidate if none was accepted
  std::vector<Vec3> node;  ///< um
  MeshHealth before, after;
  SurfaceShift shift;
  double area_change = 0;  ///< share
  bool crossed = false;    ///< the old mesh crossed itself
};

/// Better mesh for the surface of a cell, of the same volume to 1e-12. The first candidate is a
/// fresh one: a sphere mesh is cast from an inner point onto the surface, or, where a fold hides
/// the surface, onto its part visible from outside, and spread (dcm/shape/cast.hpp). Else poor
/// nodes are moved along the surface to the middle of their neighbours, then ever more of the nodes
/// around them. A mesh is accepted if it is sound, close to the old surface and does not cross
/// itself. A mesh without volume is left alone.
/// @param radius  um, reference radius
Mended mend_mesh(const geometry::Topology& topology, std::span<const Vec3> node, double radius);

}  // namespace acinus::dcm
