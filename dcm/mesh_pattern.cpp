#include "dcm/mesh_pattern.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace acinus::dcm {

namespace {

/// Edges and, if wanted, hinges of a mesh whose nodes are numbered from `first` on.
void add_mesh(const geometry::Topology& t, int first, bool hinges, solve::BlockPattern& p) {
  for (const auto& [i, j] : t.edge) p.spring.push_back({first + i, first + j});
  // a hinge's third and fourth node are the ends of its edge, in the edge's order
  if (!hinges) return;
  for (const auto& h : t.hinge) p.wing.push_back({first + h[0], first + h[1]});
}

}  // namespace

const solve::BlockPattern& shared_mesh_pattern(const geometry::Topology& t, const Params& p,
                                               const NucleusMesh& nucleus) {
  using Key = std::tuple<const geometry::Topology*, const geometry::Topology*, bool, bool>;
  static std::mutex mutex;
  static std::map<Key, std::unique_ptr<solve::BlockPattern>> kept;
  // The solver wants a hinge about every spring or about none.
  const bool hinges = p.bending_stiffness > 0 || (nucleus.exists() && p.nucleus->young > 0);
  const Key key{&t, nucleus.topology, hinges, p.local_area_modulus > 0};
  const std::scoped_lock lock(mutex);
  auto& entry = kept[key];
  if (!entry) {
    entry = std::make_unique<solve::BlockPattern>();
    entry->n_point = t.n_node + nucleus.n_node();
    add_mesh(t, 0, hinges, *entry);
    if (nucleus.exists()) add_mesh(*nucleus.topology, t.n_node, hinges, *entry);
    if (p.local_area_modulus > 0) entry->face = t.triangle;
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
