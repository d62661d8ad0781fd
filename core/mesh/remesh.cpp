#include "core/mesh/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "core/mesh/cgal_mesh.hpp"

namespace acinus::mesh {

namespace pmp = CGAL::Polygon_mesh_processing;

Surface remesh(const Surface& surface, double edge) {
  constexpr int kRounds = 3;
  CgalMesh mesh = to_cgal(surface);
  pmp::isotropic_remeshing(mesh.faces(), edge, mesh,
                           pmp::parameters::number_of_iterations(kRounds));
  return from_cgal(mesh);
}

bool crosses_itself(const Surface& surface) { return pmp::does_self_intersect(to_cgal(surface)); }

std::vector<int> find_crossing_triangles(const Surface& surface) {
  const CgalMesh mesh = to_cgal(surface);
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  std::vector<int> triangles;
  for (const auto& [f, g] : pairs)
    for (const auto face : {f, g}) triangles.push_back(static_cast<int>(face.idx()));
  std::ranges::sort(triangles);
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace acinus::mesh
