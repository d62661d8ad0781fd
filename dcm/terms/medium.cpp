#include "dcm/terms/medium.hpp"

namespace acinus::dcm {

double medium_friction_per_area(const Params& p, double radius, double rest_area) {
  if (p.viscosity <= 0) return p.medium_friction;
  return stokes_drag(p.viscosity, radius) / (rest_area * radius * radius);
}

void add_medium(const Params& p, const GroupView& g, const double* medium_area, solve::System& s) {
  double per_area[kLanes];
  for (int l = 0; l < kLanes; ++l)
    per_area[l] = medium_friction_per_area(p, g.radius[l], g.topology->rest_area);
  const Lane gamma = load(per_area), active = load(g.active), idle = 1.0 - active;
  for (int i = 0; i < g.topology->n_node; ++i) {
    const std::size_t row = g.first_row + i;
    const Lane friction = active * gamma * load(medium_area + i * kLanes) + idle;
    add_to(s.medium.data() + row * kLanes, friction);
  }
}

}  // namespace acinus::dcm
