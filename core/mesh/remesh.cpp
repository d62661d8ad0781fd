#include "core/mesh/remesh.hpp"

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

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

}  // namespace acinus::mesh
