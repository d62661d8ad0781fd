#include "geometry/implicit/cavities.hpp"

#include <algorithm>
#include <vector>

#include "geometry/components.hpp"

namespace acinus::geometry {

void remove_cavities(ZeroSurface& z) {
  geometry::Surface& s = z.surface;
  const std::vector<int> part = geometry::find_parts(s);
  std::vector<double> volume(s.node.size(), 0);  // [part] six times that
  for (const auto& [a, b, c] : s.triangle) {
    const Vec3& from = s.node[part[a]];
    volume[part[a]] += (s.node[a] - from).dot((s.node[b] - from).cross(s.node[c] - from));
  }
  if (std::ranges::none_of(volume, [](double v) { return v < 0; })) return;
  std::vector<int> number(s.node.size(), -1);
  int n = 0;
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (volume[part[k]] < 0) continue;
    number[k] = n;
    s.node[n] = s.node[k];
    z.edge[n++] = z.edge[k];
  }
  s.node.resize(n);
  z.edge.resize(n);
  std::erase_if(s.triangle, [&](const auto& corner) { return number[corner[0]] < 0; });
  for (auto& corner : s.triangle)
    for (int& k : corner) k = number[k];
}

}  // namespace acinus::geometry
