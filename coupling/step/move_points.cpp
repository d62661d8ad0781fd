#include "coupling/step/move_points.hpp"

#include <cstddef>

#include "core/parallel/threads.hpp"

namespace acinus::coupling {

void move_points(State& s, std::span<const double> d) {
  auto &dcm = s.dcm.position, &cbm = s.cbm.position;
  for_each_number(dcm.size(), [&](std::size_t k) { dcm[k] += d[k]; });
  for_each_number(cbm.size(), [&](std::size_t k) { cbm[k] += d[dcm.size() + k]; });
  if (!s.tree.node.empty()) move_tree(d.subspan(dcm.size() + cbm.size()), s.tree);
}

}  // namespace acinus::coupling
