#include "geometry/euler.hpp"

#include <vector>

#include "core/parallel/disjoint_sets.hpp"

namespace acinus::geometry {
namespace {

/// Union-find over node numbers; those that were never joined are not counted.
class JoinedNodes {
 public:
  explicit JoinedNodes(std::size_t n) : sets_(n), used_(n, 0) {}
  void join(int a, int b) {
    used_[a] = used_[b] = 1;
    sets_.join(a, b);
  }
  Connectivity count() {
    Connectivity c;
    for (int k = 0; k < static_cast<int>(used_.size()); ++k) {
      if (used_[k] == 0) continue;
      c.euler_number += 1;
      c.parts += sets_.find(k) == k ? 1 : 0;
    }
    return c;
  }

 private:
  DisjointSets sets_;
  std::vector<char> used_;
};

}  // namespace

Connectivity compute_connectivity(const Surface& s) {
  JoinedNodes nodes(s.node.size());
  for (const auto& [a, b, c] : s.triangle) {
    nodes.join(a, b);
    nodes.join(b, c);
  }
  Connectivity out = nodes.count();
  out.euler_number -= static_cast<long>(s.triangle.size() / 2);  // 3/2 edges to a triangle
  return out;
}

Connectivity compute_connectivity(const Network& n) {
  JoinedNodes nodes(n.node.size());
  for (const auto& [a, b] : n.segment) nodes.join(a, b);
  Connectivity out = nodes.count();
  out.euler_number = 2 * (out.euler_number - static_cast<long>(n.segment.size()));
  return out;
}

}  // namespace acinus::geometry
