#include "coupling/step/move_points.hpp"

#include <algorithm>
#include <cstddef>

#include "core/parallel/threads.hpp"

namespace acinus::coupling {
namespace {

/// Adds those of the numbers first, first + 1 ... that belong to x, which begins at number `begin`.
void add_overlap(std::size_t first, std::span<const double> by, std::size_t begin,
                 std::span<double> x) {
  const std::size_t from = std::max(first, begin),
                    to = std::min(first + by.size(), begin + x.size());
  if (from < to)
    for_each_number(to - from, [&](std::size_t k) { x[from - begin + k] += by[from - first + k]; });
}

}  // namespace

void move_points(State& s, std::size_t first, std::span<const double> by) {
  auto &dcm = s.dcm.position, &cbm = s.cbm.position;
  add_overlap(first, by, 0, dcm);
  add_overlap(first, by, dcm.size(), cbm);
  const std::size_t of_tree = dcm.size() + cbm.size();
  if (!s.tree.node.empty() && first + by.size() > of_tree)
    move_tree(by.subspan(of_tree - first), s.tree);
}

void move_points(State& s, std::span<const double> by) { move_points(s, 0, by); }

}  // namespace acinus::coupling
