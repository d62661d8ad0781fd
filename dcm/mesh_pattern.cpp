#include "dcm/mesh_pattern.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace acinus::dcm {

MeshPattern make_mesh_pattern(const mesh::Topology& t) {
  MeshPattern pattern;
  pattern.blocks.n_point = t.n_node;
  std::map<std::pair<int, int>, int> index;
  auto slot = [&](int a, int b) {
    const bool flipped = a > b;
    if (flipped) std::swap(a, b);
    const auto [it, added] = index.try_emplace({a, b}, static_cast<int>(index.size()));
    if (added) pattern.blocks.pair.push_back({a, b});
    return PairSlot{it->second, flipped};
  };
  for (const auto& e : t.edge) slot(e[0], e[1]);
  for (const auto& h : t.hinge) {
    std::array<PairSlot, 6> slots;
    for (std::size_t k = 0; k < 6; ++k)
      slots[k] = slot(h[static_cast<std::size_t>(kHingePairs[k][0])],
                      h[static_cast<std::size_t>(kHingePairs[k][1])]);
    pattern.hinge_pair.push_back(slots);
  }
  for (const auto& f : t.triangle)
    pattern.triangle_pair.push_back({slot(f[0], f[1]), slot(f[1], f[2]), slot(f[2], f[0])});
  return pattern;
}

const MeshPattern& shared_mesh_pattern(const mesh::Topology& topology) {
  static std::mutex mutex;
  static std::map<const mesh::Topology*, std::unique_ptr<MeshPattern>> kept;
  const std::lock_guard lock(mutex);
  auto& entry = kept[&topology];
  if (!entry) entry = std::make_unique<MeshPattern>(make_mesh_pattern(topology));
  return *entry;
}

}  // namespace acinus::dcm
