#include "geometry/components.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/parallel/disjoint_sets.hpp"
#include "core/sort_unique.hpp"

namespace acinus::geometry {

Surface compacted(const std::vector<Vec3>& node, std::vector<std::array<int, 3>> triangle) {
  std::vector<int> used;
  used.reserve(triangle.size() * 3);
  for (const auto& t : triangle) used.insert(used.end(), t.begin(), t.end());
  sort_unique(used);
  Surface out;
  out.node.reserve(used.size());
  for (const int index : used) out.node.push_back(node[index]);
  for (auto& t : triangle) {
    for (int& index : t) {
      index = static_cast<int>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
    }
  }
  out.triangle = std::move(triangle);
  return out;
}

std::vector<int> find_parts(const Surface& surface) {
  DisjointSets sets(surface.node.size());
  for (const auto& [a, b, c] : surface.triangle) {
    sets.join(a, b);
    sets.join(a, c);
  }
  std::vector<int> part(surface.node.size());
  for (int k = 0; k < static_cast<int>(part.size()); ++k) part[k] = sets.find(k);
  return part;
}

std::vector<Surface> split_components(const Surface& surface) {
  const std::vector<int> part_of_node = find_parts(surface);
  std::map<int, std::size_t> body;
  std::vector<std::vector<std::array<int, 3>>> triangle;
  for (const auto& t : surface.triangle) {
    const std::size_t b = body.try_emplace(part_of_node[t[0]], triangle.size()).first->second;
    if (b == triangle.size()) triangle.emplace_back();
    triangle[b].push_back(t);
  }
  std::vector<Surface> bodies;
  for (auto& part : triangle) bodies.push_back(compacted(surface.node, std::move(part)));
  return bodies;
}

}  // namespace acinus::geometry
