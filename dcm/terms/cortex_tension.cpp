#include "dcm/terms/cortex_tension.hpp"

#include <cmath>

#include "dcm/terms/area.hpp"

namespace acinus::dcm {
namespace {

ACINUS_KERNEL void tension_forces(double tension, const GroupView& g, double* force) {
  const Lane pull = -tension * load(g.active);
  for (const auto& f : g.topology->triangle) {
    const Lane3 x0 = load3(g.position + f[0] * kPointStride);
    const Lane3 x1 = load3(g.position + f[1] * kPointStride);
    const Lane3 x2 = load3(g.position + f[2] * kPointStride);
    const Lane3 c = cross(x1 - x0, x2 - x0);
    const Lane3 half_pull = (0.5 * pull / lane_sqrt(dot(c, c))) * c;
    add3(force + f[0] * kPointStride, cross(half_pull, x2 - x1));
    add3(force + f[1] * kPointStride, cross(half_pull, x0 - x2));
    add3(force + f[2] * kPointStride, cross(half_pull, x1 - x0));
  }
}

/// Unit vectors are stored as floats and may come out longer than 1 by this much; with so much less
/// taken off along the edge the matrix has no negative eigenvalue.
constexpr double kRounding = 1e-6;

ACINUS_KERNEL void tension_springs(double across, const GroupView& g, float* element) {
  const Lane c = across * load(g.active);
  for (const auto& [i, j] : g.topology->edge) {
    const Lane3 d = load3(g.position + j * kPointStride) - load3(g.position + i * kPointStride);
    solve::add_spring(element, (1.0 / lane_sqrt(dot(d, d))) * d, (kRounding - 1) * c, c);
    element += solve::kSpringStride;
  }
}

}  // namespace

void add_cortex_tension(const Params& p, const GroupView& g, solve::System& s) {
  tension_forces(p.cortex_tension, g, s.force.data() + g.first_row * kPointStride);
  tension_springs(s.stiffness_scale * p.cortex_tension / std::sqrt(3.0), g,
                  s.spring.data() + g.first_spring * solve::kSpringStride);
}

double cortex_tension_energy(const Params& p, const GroupView& g, int lane) {
  return g.active[lane] * p.cortex_tension * compute_areas(g)[lane];
}

}  // namespace acinus::dcm
