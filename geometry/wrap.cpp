#include "geometry/wrap.hpp"

#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/cgal_mesh.hpp"

namespace acinus::geometry {

Surface wrap(const Surface& surface, double alpha, double offset) {
  std::vector<CgalKernel::Point_3> point;
  std::vector<std::array<std::size_t, 3>> face;
  for (const Vec3& x : surface.node) point.emplace_back(x[0], x[1], x[2]);
  for (const auto& corner : surface.triangle) {
    std::array<std::size_t, 3> f{};
    for (std::size_t k = 0; k < 3; ++k) f[k] = corner[k];
    face.push_back(f);
  }
  CgalMesh mesh;
  CGAL::alpha_wrap_3(point, face, alpha, offset, mesh);
  return from_cgal(mesh);
}

}  // namespace acinus::geometry
