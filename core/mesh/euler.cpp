#include "core/mesh/euler.hpp"

#include <numeric>
#include <vector>

namespace acinus::mesh {
namespace {

/// Disjoint sets of numbers; those that were never joined to anything are not counted.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n), used_(n, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void join(int a, int b) {
    used_[a] = used_[b] = 1;
    parent_[find(a)] = find(b);
  }
  Connectivity count() {
    Connectivity c;
    for (std::size_t k = 0; k < parent_.size(); ++k) {
      if (used_[k] == 0) continue;
      c.euler_number += 1;  // a node
      c.parts += find(static_cast<int>(k)) == static_cast<int>(k) ? 1 : 0;
    }
    return c;
  }

 private:
  int find(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  std::vector<int> parent_;
  std::vector<char> used_;
};

}  // namespace

Connectivity find_connectivity(const Surface& s) {
  DisjointSets sets(s.node.size());
  for (const auto& [a, b, c] : s.triangle) {
    sets.join(a, b);
    sets.join(b, c);
  }
  Connectivity out = sets.count();
  out.euler_number -= static_cast<long>(s.triangle.size() / 2);  // 3/2 edges to a triangle
  return out;
}

Connectivity find_connectivity(const Network& n) {
  DisjointSets sets(n.node.size());
  for (const auto& [a, b] : n.segment) sets.join(a, b);
  Connectivity out = sets.count();
  out.euler_number = 2 * (out.euler_number - static_cast<long>(n.segment.size()));
  return out;
}

}  // namespace acinus::mesh
