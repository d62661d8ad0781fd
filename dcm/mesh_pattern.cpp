#include "dcm/mesh_pattern.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace acinus::dcm {

const solve::BlockPattern& shared_mesh_pattern(const mesh::Topology& t, const Params& p) {
  using Key = std::tuple<const mesh::Topology*, bool, bool>;
  static std::mutex mutex;
  static std::map<Key, std::unique_ptr<solve::BlockPattern>> kept;
  const Key key{&t, p.bending_stiffness > 0, p.local_area_modulus > 0};
  const std::scoped_lock lock(mutex);
  auto& entry = kept[key];
  if (!entry) {
    entry = std::make_unique<solve::BlockPattern>();
    entry->n_point = t.n_node;
    entry->spring = t.edge;
    // a hinge's third and fourth node are the ends of its edge, in the edge's order
    if (std::get<1>(key))
      for (const auto& h : t.hinge) entry->wing.push_back({h[0], h[1]});
    if (std::get<2>(key)) entry->face = t.triangle;
    solve::index_springs(*entry);
  }
  return *entry;
}

const solve::BlockPattern& shared_point_pattern(int n_point) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<solve::BlockPattern>> kept;
  const std::scoped_lock lock(mutex);
  auto& entry = kept[n_point];
  if (!entry) {
    entry = std::make_unique<solve::BlockPattern>();
    entry->n_point = n_point;
  }
  return *entry;
}

}  // namespace acinus::dcm
