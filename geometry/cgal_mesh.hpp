#pragma once
/// Conversion of surfaces to CGAL meshes. Only for source files with the compile flags of CGAL.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "geometry/surface.hpp"

namespace acinus::geometry {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

inline Vec3 place_of(const CgalMesh& mesh, CgalMesh::Vertex_index v) {
  const auto& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

/// Surface as a CGAL mesh. @pre check_manifold
inline CgalMesh to_cgal(const Surface& s) {
  CgalMesh mesh;
  mesh.reserve(s.node.size(), 3 * s.triangle.size() / 2, s.triangle.size());
  std::vector<CgalMesh::Vertex_index> vertex;
  for (const Vec3& x : s.node) vertex.push_back(mesh.add_vertex({x[0], x[1], x[2]}));
  for (const auto& [a, b, c] : s.triangle) mesh.add_face(vertex[a], vertex[b], vertex[c]);
  return mesh;
}

inline Surface from_cgal(const CgalMesh& mesh) {
  Surface out;
  std::vector<int> number(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<int>(out.node.size());
    out.node.push_back(place_of(mesh, v));
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corner{};
    std::size_t n = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corner[n++] = number[v];
    out.triangle.push_back(corner);
  }
  return out;
}

}  // namespace acinus::geometry
