#include "contact/static_mesh.hpp"

#include <utility>

namespace acinus::contact {

StaticMesh make_static_mesh(std::string name, geometry::Surface surface, bool inside) {
  if (inside)
    for (auto& t : surface.triangle) std::swap(t[1], t[2]);
  StaticMesh m;
  m.name = std::move(name);
  m.inside = inside;
  m.triangle = std::make_shared<const std::vector<std::array<int, 3>>>(std::move(surface.triangle));
  m.body.node = std::move(surface.node);
  m.body.triangle = m.triangle.get();
  refresh_body(m.body);
  return m;
}

}  // namespace acinus::contact
