#include "coupling/subworld/center_hold.hpp"

#include <algorithm>
#include <utility>

#include "dcm/loads/loads.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

/// Stiffness of a spring, nN/um: far above that of the contacts of a cell.
constexpr double kStiffness = 1e4;

/// Derivative of the centroid of an enclosed volume, [node]: row k holds that of coordinate k.
std::vector<Mat3> centroid_gradient(std::vector<Vec3> node, const geometry::Topology& t,
                                    const Vec3& centroid) {
  for (Vec3& x : node) x -= centroid;
  const double volume = geometry::compute_volume(node, t.triangle);
  std::vector<Mat3> gradient(node.size(), Mat3::Zero());
  for (const auto& triangle : t.triangle) {
    const auto corner = [&](int k) { return node[triangle[k % 3]]; };
    // A tetrahedron with its tip at the centroid: volume V, first moment V (a + b + c)/4.
    const Vec3 sum = corner(0) + corner(1) + corner(2);
    const double tetrahedron = corner(0).dot(corner(1).cross(corner(2))) / 6;
    for (int k = 0; k < 3; ++k)
      gradient[triangle[k]] += (sum / 24 * corner(k + 1).cross(corner(k + 2)).transpose() +
                                tetrahedron / 4 * Mat3::Identity()) /
                               volume;
  }
  return gradient;
}

}  // namespace

void CenterHold::add_loads(double /*time*/, const LoadedCells& cells,
                           std::span<solve::RankOne> own) const {
  dcm::for_each_loaded_group(cells.state, cells.lanes, cells.system, [&](const dcm::GroupView& g) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const auto at =
          std::ranges::find(held, cells.state.lineage[g.index * kLanes + l], &HeldCentroid::cell);
      if (g.active[l] == 0 || at == held.end()) continue;
      std::vector<Vec3> node;
      for (int i = 0; i < g.topology->n_node; ++i)
        node.push_back(load_point(g.position, make_address(i, l)));
      const Vec3 centroid = geometry::compute_centroid(node, g.topology->triangle);
      const Vec3 force = kStiffness * (at->centroid - centroid);
      const std::vector<Mat3> gradient = centroid_gradient(std::move(node), *g.topology, centroid);
      for (int i = 0; i < g.topology->n_node; ++i) {
        const Address address = make_address(g.first_row + i, l);
        add_point(cells.system.external_force.data(), address,
                  Vec3(gradient[i].transpose() * force));
        for (int k = 0; k < 3; ++k)
          store_point(own[k].vector.data(), address, Vec3(gradient[i].row(k).transpose()));
      }
      for (int k = 0; k < 3; ++k)
        own[k].coefficient[g.index * kLanes + l] = cells.system.stiffness_scale * kStiffness;
    }
  });
}

}  // namespace acinus::coupling
