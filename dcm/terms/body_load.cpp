#include "dcm/terms/body_load.hpp"

namespace acinus::dcm {

void add_body_load(const GroupView& g, std::span<const Vec3> cell_force, solve::System& s) {
  for (int i = 0; i < g.topology->n_node; ++i) {
    const double share = g.topology->rest_node_area[i] / g.topology->rest_area;
    const std::size_t row = g.first_row + i;
    for (int l = 0; l < kLanes; ++l)
      if (g.active[l] != 0)
        add_point(s.external_force.data(), make_address(row, l), share * cell_force[l]);
  }
}

}  // namespace acinus::dcm
