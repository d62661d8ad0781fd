#include "coupling/step/turned_faces.hpp"

#include <vector>

namespace acinus::coupling {
namespace {

/// Least share of its area that a face keeps in a step, projected on its normal: faces that shrink
/// faster are resolved by shorter steps before their normal degenerates.
constexpr double kLeastArea = 0.25;

/// True if a move inverts a face, or nearly, or folds two faces of an edge through each other.
/// @param first  number of the first node of the mesh among the points of the cell
bool turns_over(const dcm::State& s, std::size_t lane, const geometry::Topology& t, int first,
                std::span<const double> move) {
  struct Normals {
    Vec3 before, after;
  };
  thread_local std::vector<Normals> normal;
  normal.clear();
  for (const auto& corner : t.triangle) {
    Vec3 before[3], after[3];
    for (std::size_t m = 0; m < 3; ++m) {
      const Address a = dcm::node_address(s, lane, first + corner[m]);
      before[m] = load_point(s.position.data(), a);
      after[m] = before[m] + load_point(move.data(), a);
    }
    normal.push_back({(before[1] - before[0]).cross(before[2] - before[0]),
                      (after[1] - after[0]).cross(after[2] - after[0])});
    const auto& [was, is] = normal.back();
    if (!(was.dot(is) > kLeastArea * was.squaredNorm())) return true;
  }
  for (std::size_t e = 0; e < t.edge.size(); ++e) {
    const Normals &f = normal[t.edge_triangle[e][0]], &g = normal[t.edge_triangle[e][1]];
    if (f.before.dot(g.before) > 0 || f.after.dot(g.after) > 0) continue;
    // Faces beyond a right angle on both sides of the step: the edge must bend the same way still.
    const Address a = dcm::node_address(s, lane, first + t.edge[e][0]),
                  b = dcm::node_address(s, lane, first + t.edge[e][1]);
    const Vec3 along = load_point(s.position.data(), b) - load_point(s.position.data(), a);
    const Vec3 moved = load_point(move.data(), b) - load_point(move.data(), a);
    if (f.before.cross(g.before).dot(along) * f.after.cross(g.after).dot(along + moved) < 0)
      return true;
  }
  return false;
}

}  // namespace

bool turns_over(const dcm::State& s, std::size_t lane, std::span<const double> move) {
  const dcm::Group& g = s.group[lane / kLanes];
  if (turns_over(s, lane, *g.topology, 0, move)) return true;
  return g.nucleus.exists() && turns_over(s, lane, *g.nucleus.topology, g.topology->n_node, move);
}

}  // namespace acinus::coupling
