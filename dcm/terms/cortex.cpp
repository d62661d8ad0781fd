#include "dcm/terms/cortex.hpp"

namespace acinus::dcm {
namespace {

ACINUS_KERNEL void cortex_kernel(const Params& p, const GroupView& g, double stiffness_scale,
                                 double friction_scale, double* force, float* element) {
  const geometry::Topology& t = *g.topology;
  const Lane radius = load(g.radius), active = load(g.active);
  const Lane k = p.spring_stiffness * active;
  const Lane friction = (p.nodal_friction * friction_scale) * active;
  const double* rest = t.rest_length.data();
  for (int e = 0; e < t.n_edge; ++e) {
    const int i = t.edge[e][0], j = t.edge[e][1];
    const Lane3 d = load3(g.position + j * kPointStride) - load3(g.position + i * kPointStride);
    const Lane length = lane_sqrt(dot(d, d));
    const Lane inverse = 1.0 / length;
    const Lane3 u = inverse * d;
    Lane l0 = rest[e] * radius;
    if (g.edge) l0 = l0 * load(g.edge + e * kLanes);
    const Lane3 f = (k * (length - l0)) * u;
    add3(force + i * kPointStride, f);
    add3(force + j * kPointStride, -f);

    // along u: stiffness and dashpot; across: tension's geometric part and dashpot
    const Lane geometric = stiffness_scale * lane_max0(k * (1.0 - l0 * inverse));
    const Lane across = geometric + p.friction_across * friction;
    const Lane along = stiffness_scale * k + friction;
    solve::add_spring(element, (along - across) * inverse * inverse, across);
    element += solve::kSpringStride;
  }
}

}  // namespace

void add_cortex(const Params& p, const GroupView& g, solve::System& s) {
  cortex_kernel(p, g, s.stiffness_scale, s.friction_scale,
                s.force.data() + g.first_row * kPointStride,
                s.spring.data() + g.first_spring * solve::kSpringStride);
}

double cortex_energy(const Params& p, const GroupView& g, int lane) {
  double energy = 0;
  for (std::size_t e = 0; e < g.topology->edge.size(); ++e) {
    const auto& [i, j] = g.topology->edge[e];
    const double length = (load_point(g.position, make_address(j, lane)) -
                           load_point(g.position, make_address(i, lane)))
                              .norm();
    const double stretch = length - rest_length(g, e, lane);
    energy += 0.5 * p.spring_stiffness * stretch * stretch;
  }
  return g.active[lane] * energy;
}

}  // namespace acinus::dcm
