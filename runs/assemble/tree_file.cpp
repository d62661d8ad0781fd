#include "runs/assemble/tree_file.hpp"

#include "runs/assemble/state_numbers.hpp"

namespace acinus::runs {

void put_tree(const coupling::TreeState& tree, io::CheckpointData& d) {
  if (tree.node.empty()) return;
  d.put("tree/node", flatten(tree.node));
  std::vector<double> rotation;
  for (const Eigen::Quaterniond& q : tree.rotation)
    rotation.insert(rotation.end(), {q.w(), q.x(), q.y(), q.z()});
  d.put("tree/rotation", rotation);
}

void get_tree(const io::CheckpointData& d, coupling::TreeState& tree) {
  if (tree.node.empty()) return;
  const std::size_t n = tree.node.size();
  tree.node = unflatten_points(d.numbers("tree/node"));
  check_same(d, "tree/node", tree.node.size(), n);
  const std::vector<double>& rotation = d.numbers("tree/rotation");
  check_same(d, "tree/rotation", rotation.size(), 4 * n);
  for (std::size_t k = 0; k < n; ++k)
    tree.rotation[k] = Eigen::Quaterniond(rotation[4 * k], rotation[4 * k + 1], rotation[4 * k + 2],
                                          rotation[4 * k + 3]);
}

}  // namespace acinus::runs
