#include "dcm/terms/cortex_tension.hpp"

#include <cmath>
#include <vector>

#include "dcm/terms/area.hpp"
#include "dcm/terms/matrix_shape.hpp"

namespace acinus::dcm {
namespace {

bool has_ring(const Params& p) { return p.ring && p.ring->excess > 0; }

/// Mean of the nodes of a lane, weighted by their share of the rest surface.
Vec3 center_of_lane(const GroupView& g, int lane) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < g.topology->n_node; ++i)
    sum += g.topology->rest_node_area[i] * load_point(g.position, make_address(i, lane));
  return sum / g.topology->rest_area;
}

/// Computes the ratio of the tension of each triangle to that at the poles, [n_triangle][lane].
void compute_ring_factors(const ContractileRing& c, const GroupView& g,
                          std::vector<double>& factor) {
  const geometry::Topology& t = *g.topology;
  const Vec3 axis = c.axis.normalized();
  factor.resize(t.triangle.size() * kLanes);
  for (int l = 0; l < kLanes; ++l) {
    const Vec3 center = center_of_lane(g, l);
    for (std::size_t f = 0; f < t.triangle.size(); ++f) {
      Vec3 arm = -center;
      for (const int i : t.triangle[f]) arm += load_point(g.position, make_address(i, l)) / 3;
      factor[f * kLanes + l] = ring_factor(c, axis.dot(arm) / arm.norm());
    }
  }
}

/// Adds the forces of a tension. @param factor  [n_triangle][lane]; null: all 1
ACINUS_KERNEL void tension_forces(double tension, const GroupView& g, const double* factor,
                                  double* force) {
  const Lane uniform = -tension * load(g.active);
  for (std::size_t k = 0; k < g.topology->triangle.size(); ++k) {
    const auto& f = g.topology->triangle[k];
    const Lane3 x0 = load3(g.position + f[0] * kPointStride);
    const Lane3 x1 = load3(g.position + f[1] * kPointStride);
    const Lane3 x2 = load3(g.position + f[2] * kPointStride);
    const Lane3 c = cross(x1 - x0, x2 - x0);
    const Lane pull = factor ? uniform * load(factor + k * kLanes) : uniform;
    const Lane3 half_pull = (0.5 * pull / lane_sqrt(dot(c, c))) * c;
    add3(force + f[0] * kPointStride, cross(half_pull, x2 - x1));
    add3(force + f[1] * kPointStride, cross(half_pull, x0 - x2));
    add3(force + f[2] * kPointStride, cross(half_pull, x1 - x0));
  }
}

/// Bound of the rounding of coefficients stored as floats; reduced by as much along the edge, the
/// matrix has no negative eigenvalue.
constexpr double kRounding = 1e-6;

/// Adds the geometric stiffness.
/// @param factor  [n_triangle][lane], of which an edge takes the mean of its two; null: all 1
ACINUS_KERNEL void tension_springs(double across, const GroupView& g, const double* factor,
                                   const float* shape, float* element) {
  const geometry::Topology& t = *g.topology;
  const Lane uniform = across * load(g.active);
  for (std::size_t e = 0; e < t.edge.size(); ++e) {
    Lane c = uniform;
    if (factor)
      c = c * (0.5 * (load(factor + t.edge_triangle[e][0] * kLanes) +
                      load(factor + t.edge_triangle[e][1] * kLanes)));
    const Lane squared = squared_length(shape, t.edge[e][0], t.edge[e][1]);
    solve::add_spring(element, (kRounding - 1) * c / squared, c);
    element += solve::kSpringStride;
  }
}

}  // namespace

double ring_factor(const ContractileRing& c, double cosine) {
  return 1 + c.excess * std::exp(-cosine * cosine / (2 * c.width * c.width));
}

void add_cortex_tension(const Params& p, const GroupView& g, solve::System& s) {
  thread_local std::vector<double> ring;  // a warmed-up step allocates nothing
  if (has_ring(p)) compute_ring_factors(*p.ring, g, ring);
  const double* factor = has_ring(p) ? ring.data() : nullptr;
  tension_forces(p.cortex_tension, g, factor, s.force.data() + g.first_row * kPointStride);
  tension_springs(s.stiffness_scale * p.cortex_tension / std::sqrt(3.0), g, factor, shape_of(g, s),
                  s.spring.data() + g.first_spring * solve::kSpringStride);
}

double cortex_tension_energy(const Params& p, const GroupView& g, int lane) {
  if (!has_ring(p)) return g.active[lane] * p.cortex_tension * compute_areas(g)[lane];
  std::vector<double> factor;
  compute_ring_factors(*p.ring, g, factor);
  double energy = 0;
  for (std::size_t f = 0; f < g.topology->triangle.size(); ++f)
    energy += p.cortex_tension * factor[f * kLanes + lane] * triangle_area(g, f, lane);
  return g.active[lane] * energy;
}

void add_active_tension(const Params& p, const GroupView& g, int lane, std::span<double> tension) {
  if (!has_ring(p)) {
    for (double& t : tension) t += p.cortex_tension;
    return;
  }
  const Vec3 center = center_of_lane(g, lane), axis = p.ring->axis.normalized();
  for (std::size_t i = 0; i < tension.size(); ++i) {
    const Vec3 arm = load_point(g.position, make_address(static_cast<int>(i), lane)) - center;
    tension[i] += p.cortex_tension * ring_factor(*p.ring, axis.dot(arm) / arm.norm());
  }
}

}  // namespace acinus::dcm
