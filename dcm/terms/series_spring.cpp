#include "dcm/terms/series_spring.hpp"

#include "dcm/edge_tension.hpp"

namespace acinus::dcm {
namespace {

ACINUS_KERNEL void series_kernel(const Params& p, const GroupView& g, const SeriesStep& step,
                                 solve::System& s) {
  const geometry::Topology& t = *g.topology;
  const double stiffness_scale = s.stiffness_scale, friction_scale = s.friction_scale;
  double* const force = s.force.data() + g.first_row * kPointStride;
  float* element = s.spring.data() + g.first_spring * solve::kSpringStride;
  const Lane active = load(g.active);
  const Lane k = (step.share * p.spring_stiffness) * active;
  const Lane kept = step.kept * active;
  const Lane friction = (p.nodal_friction * friction_scale) * active;
  for (int e = 0; e < t.n_edge; ++e) {
    const int i = t.edge[e][0], j = t.edge[e][1];
    const Lane3 d = load3(g.position + j * kPointStride) - load3(g.position + i * kPointStride);
    const Lane length = lane_sqrt(dot(d, d));
    const Lane inverse = 1.0 / length;
    const Lane3 u = inverse * d;
    Lane tension = 0.0 * length;
    if (g.tension)
      tension = kept * load(g.tension + e * kLanes) + k * (length - load(g.length + e * kLanes));
    const Lane3 f = tension * u;
    add3(force + i * kPointStride, f);
    add3(force + j * kPointStride, -f);

    const Lane geometric = stiffness_scale * lane_max0(tension * inverse);
    const Lane across = geometric + p.friction_across * friction;
    const Lane along = stiffness_scale * k + friction;
    solve::add_spring(element, (along - across) * inverse * inverse, across);
    element += solve::kSpringStride;
  }
}

}  // namespace

void add_series_springs(const Params& p, const GroupView& g, solve::System& s) {
  // An explicit step has the tension at its start only.
  const double step = s.stiffness_scale > 0 ? 1 / s.friction_scale : 0;
  series_kernel(p, g, series_step(p.spring_stiffness, p.series_friction, step), s);
}

double series_spring_energy(const Params& p, const GroupView& g, int lane) {
  if (!g.tension) return 0;
  double energy = 0;
  for (int e = 0; e < g.topology->n_edge; ++e) {
    const double f = g.tension[e * kLanes + lane];
    energy += f * f / (2 * p.spring_stiffness);
  }
  return g.active[lane] * energy;
}

}  // namespace acinus::dcm
