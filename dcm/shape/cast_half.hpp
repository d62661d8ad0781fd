#pragma once
/// Mesh of a daughter cell: a sphere mesh laid onto half a cell so that a closed ring of its edges
/// runs along the rim between the cut face and the mother's surface.

#include <optional>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "dcm/shape/cast.hpp"
#include "geometry/surface.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Parts of an icosphere on half a cell. Node 0, a corner of the icosahedron, is the pole of the
/// cap. The ring is made of the five icosahedron edges around it, the nodes as many edges away as
/// an icosahedron edge has parts: a quarter of all triangles lies inside it. A hemisphere has a
/// third of its area there, so its curved side, where chords lose volume, gets the finer triangles.
/// The next ring (3/8 inside) loses nearly 1.2 times as much volume on a halved sphere.
/// Throws Error for a topology that is not an icosphere.
std::vector<Part> make_parts(const geometry::Topology& topology);

struct HalfMesh {
  std::vector<Vec3> node;      ///< [n_node] um, on the surface of the half
  Vec3 center = Vec3::Zero();  ///< point that sees every face from its inner side
};

/// Lays an icosphere onto half a cell: the ring at equal distances along the rim, the cap between
/// its centroid and the rim, the shell by rays from a star centre of the half; then spreads both.
/// @param half  as made by geometry::cut_surface: the last rim.size() - 2 triangles are the cap
/// @param rim   counter-clockwise seen from outside the cap (for the upper half of a cut, its loop
///              turned round)
/// @param turn  start of the ring, as part of the rim's length behind its first point
/// @return      empty when the half is not star-shaped or the mesh would fold
std::optional<HalfMesh> cast_half(const geometry::Topology& topology, const geometry::Surface& half,
                                  std::span<const Vec3> rim, double turn);

}  // namespace acinus::dcm
