#include "coupling/apparatus/pull/pull_spring.hpp"

namespace acinus::coupling {

void add_pull_springs(const dcm::GroupView& g, std::span<const PullSpring> spring, solve::System& s,
                      solve::RankOne& family) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    const PullSpring& held = spring[l];
    if (g.active[l] == 0 || !(held.stiffness > 0)) continue;
    const auto share = [&](int i) { return g.topology->rest_node_area[i] / g.topology->rest_area; };
    double place = 0;
    for (int i = 0; i < g.topology->n_node; ++i)
      place += share(i) * held.direction.dot(load_point(g.position, make_address(i, l)));
    const double force = held.stiffness * (held.end - place);
    for (int i = 0; i < g.topology->n_node; ++i) {
      const Address node = make_address(g.first_row + i, l);
      const Vec3 gradient = share(i) * held.direction;
      add_point(s.external_force.data(), node, force * gradient);
      for (int k = 0; k < 3; ++k)
        family.vector[node + k * kLanes] = static_cast<float>(gradient[k]);
    }
    family.coefficient[g.index * kLanes + l] = s.stiffness_scale * held.stiffness;
  }
}

}  // namespace acinus::coupling
