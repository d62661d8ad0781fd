#include "dcm/terms/area.hpp"

#include <algorithm>
#include <cmath>

#include "dcm/terms/matrix_shape.hpp"
#include "dcm/terms/rank_one.hpp"

namespace acinus::dcm {
namespace {

/// Adds dA/dx to `gradient` and writes the area A.
ACINUS_KERNEL void area_kernel(const GroupView& g, double* gradient, double* area) {
  Lane sum = lane_of(0);
  for (const auto& f : g.topology->triangle) {
    const Lane3 x0 = load3(g.position + f[0] * kPointStride);
    const Lane3 x1 = load3(g.position + f[1] * kPointStride);
    const Lane3 x2 = load3(g.position + f[2] * kPointStride);
    const Lane3 c = cross(x1 - x0, x2 - x0);
    const Lane norm = lane_sqrt(dot(c, c));
    sum += 0.5 * norm;
    if (!gradient) continue;
    const Lane3 half_normal = (0.5 / norm) * c;
    add3(gradient + f[0] * kPointStride, cross(half_normal, x2 - x1));
    add3(gradient + f[1] * kPointStride, cross(half_normal, x0 - x2));
    add3(gradient + f[2] * kPointStride, cross(half_normal, x1 - x0));
  }
  store(area, sum);
}

/// Adds across (I - u u^T) between the ends of every edge, in the direction u.
ACINUS_KERNEL void tension_kernel(const GroupView& g, const double* across_of_lane,
                                  const float* shape, float* element) {
  const Lane across = load(across_of_lane);
  for (const auto& [i, j] : g.topology->edge) {
    solve::add_spring(element, -across / squared_length(shape, i, j), across);
    element += solve::kSpringStride;
  }
}

}  // namespace

void add_area(const Params& p, const GroupView& g, solve::System& s, solve::RankOne& family) {
  double* const gradient = zero_gradient(g.topology->n_node);
  double area[kLanes], pull[kLanes], across[kLanes];
  area_kernel(g, gradient, area);
  round_gradient(g.topology->n_node, gradient, family.vector.data() + g.first_row * kPointStride);
  bool tense = false;
  for (int l = 0; l < kLanes; ++l) {
    const double a0 = rest_area(g, l);
    pull[l] = -g.active[l] * p.area_modulus * (area[l] - a0) / a0;
    family.coefficient[g.index * kLanes + l] =
        s.stiffness_scale * g.active[l] * p.area_modulus / a0;
    across[l] = s.stiffness_scale * std::max(0.0, -pull[l]) / std::sqrt(3.0);
    tense = tense || across[l] > 0;
  }
  if (tense)
    tension_kernel(g, across, shape_of(g, s),
                   s.spring.data() + g.first_spring * solve::kSpringStride);
  add_scaled(g.topology->n_node, pull, gradient, s.force.data() + g.first_row * kPointStride);
}

Lane compute_areas(const GroupView& g) {
  double area[kLanes];
  area_kernel(g, nullptr, area);
  return load(area);
}

double area_energy(const Params& p, const GroupView& g, int lane) {
  const double a0 = rest_area(g, lane);
  const double stretch = compute_areas(g)[lane] - a0;
  return g.active[lane] * p.area_modulus * stretch * stretch / (2 * a0);
}

}  // namespace acinus::dcm
