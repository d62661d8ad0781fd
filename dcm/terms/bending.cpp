#include "dcm/terms/bending.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::dcm {
namespace {

/// Barrier against two faces that fold onto each other, fold = max(0, start - cos theta) / (1 + cos
/// theta).
struct Barrier {
  double start;  ///< cos theta where it begins
  double floor;  ///< 1 + cos theta below which it is linear, so that all numbers are finite
};
/// Barrier of bending: begins at 60 degrees between the faces, and is linear below 11.
constexpr Barrier kBending{-0.5, 0.02};
/// Barrier that keeps the two faces of a hinge apart: begins at 26 degrees between them, and is
/// linear below 3.6.
constexpr Barrier kTouching{-0.9, 0.002};
/// Depth at which two faces pressed on each other have the energy scale of the barrier of contact,
/// um.
constexpr double kTouchDepth = 0.1;

/// Share of its reference area below which a face resists collapse.
constexpr double kLeastArea = 0.1;

/// Collapse of a face: k_b compression^2 / 3 in each of its three hinges.
struct Collapse {
  Lane compression;  ///< kLeastArea a0 / a - 1
  Lane slope;        ///< -d compression / d a, 1/um^2
};
ACINUS_INLINE Collapse find_collapse(Lane least, Lane area) {
  const Lane inverse = 1.0 / area;
  const Lane compression = lane_max0(least * inverse - 1.0);
  return {compression, compression > 0.0 ? least * inverse * inverse : lane_of(0)};
}

/// Face of a hinge: corners about its normal, the last two on the edge.
struct HingeFace {
  Lane3 x[3];
  Lane3 normal;
  double* force[3];
};

/// Adds the share of one hinge in the resistance of a face.
ACINUS_INLINE void add_collapse(Lane k, const Collapse& c, double stiffness_scale,
                                const HingeFace& face, float* spring) {
  const auto& [x, normal, force] = face;
  const Lane3 half_normal = (0.5 / lane_sqrt(dot(normal, normal))) * normal;
  const Lane push = (2.0 / 3.0) * k * c.compression * c.slope;
  add3(force[0], push * cross(half_normal, x[2] - x[1]));
  add3(force[1], push * cross(half_normal, x[0] - x[2]));
  add3(force[2], push * cross(half_normal, x[1] - x[0]));
  // (sum_i g_i x_i)^2 <= 1/3 sum over edges of |g_i - g_j|^2 |x_i - x_j|^2, as the g_i add up to 0:
  // a spring along every edge that is at least as stiff in all directions.
  const Lane3 median = x[0] - lane_of(0.5) * (x[1] + x[2]);
  const Lane stiffness = (2.0 / 3.0) * k * c.slope * c.slope * dot(median, median);
  float* const across = spring + kLanes;
  store(across, load(across) + stiffness_scale * stiffness);
}

/// Derivative by theta of a law over its stiffness, and the positive part of the second one.
struct FoldLaw {
  Lane moment, slope;
};

/// Derivatives of fold^2.
ACINUS_INLINE FoldLaw barrier_law(const Barrier& barrier, Lane cos_theta, Lane sin_theta) {
  // Below the floor, fold goes on along its tangent.
  const Lane below = lane_max0(barrier.floor - (1.0 + cos_theta));
  const Lane open = barrier.floor + lane_max0(1.0 + cos_theta - barrier.floor);
  const Lane inverse_open = 1.0 / open;
  const Lane at_open = lane_max0(barrier.start - cos_theta - below) * inverse_open;
  const Lane growth = inverse_open * (1.0 + at_open);  // -d fold / d cos theta
  const Lane fold = at_open + growth * below;
  const Lane slope = fold > 0.0 ? sin_theta * growth : lane_of(0);  // d fold / d theta
  return {2.0 * fold * slope, 2.0 * slope * slope};
}

/// Derivatives of the energy of a hinge with its barrier, over k_b.
/// @param c0, s0  cosine and sine of the rest angle
ACINUS_INLINE FoldLaw hinge_law(Lane cos_theta, Lane sin_theta, double c0, double s0) {
  const FoldLaw barrier = barrier_law(kBending, cos_theta, sin_theta);
  return {sin_theta * c0 - cos_theta * s0 + barrier.moment,
          lane_max0(cos_theta * c0 + sin_theta * s0) + barrier.slope};
}

/// Energy of two faces of mean size pressed kTouchDepth into each other, over radius^2, nN/um.
double touch_stiffness(const Params& p, const geometry::Topology& t) {
  return 0.5 * p.fold_repulsion * kTouchDepth * kTouchDepth * t.rest_area / t.n_triangle;
}

/// Both faces of an edge, as input of the barrier against their collapse.
struct EdgeFaces {
  Lane stiffness;
  double stiffness_scale;
  Lane3 x[4];           ///< um, nodes of the hinge
  Lane3 n1, n2;         ///< um^2, twice the vector areas
  Lane s1, s2;          ///< um^4, their squares
  Lane least1, least2;  ///< um^2, areas below which the barrier acts
};

/// Adds the barriers of faces that have almost no area left.
ACINUS_INLINE void add_collapses(const EdgeFaces& f, const std::array<int, 4>& h, double* force,
                                 float* spring) {
  const Collapse c1 = find_collapse(f.least1, 0.5 * lane_sqrt(f.s1)),
                 c2 = find_collapse(f.least2, 0.5 * lane_sqrt(f.s2));
  double* const at[4] = {force + h[0] * kPointStride, force + h[1] * kPointStride,
                         force + h[2] * kPointStride, force + h[3] * kPointStride};
  add_collapse(f.stiffness, c1, f.stiffness_scale,
               {{f.x[0], f.x[2], f.x[3]}, f.n1, {at[0], at[2], at[3]}}, spring);
  add_collapse(f.stiffness, c2, f.stiffness_scale,
               {{f.x[1], f.x[3], f.x[2]}, f.n2, {at[1], at[3], at[2]}}, spring);
}

/// Arrays that the kernel writes.
struct BendingOutput {
  double* force;
  float *hinge, *spring;
};

ACINUS_KERNEL void bending_kernel(const Params& p, const GroupView& g, double stiffness_scale,
                                  const BendingOutput& out) {
  auto [force, element, spring] = out;
  const geometry::Topology& t = *g.topology;
  const Lane k = p.bending_stiffness * load(g.active);
  const Lane radius = load(g.radius);
  const Lane touching = touch_stiffness(p, t) * load(g.active) * radius * radius;
  const auto least_area = [&](int triangle) {
    const std::size_t f = triangle;
    const Lane a0 = (kLeastArea * t.rest_triangle_area[f]) * radius * radius;
    return g.triangle ? a0 * load(g.triangle + f * kLanes) : a0;
  };
  for (int e = 0; e < t.n_edge; ++e) {
    const auto& h = t.hinge[e];
    const Lane3 x1 = load3(g.position + h[0] * kPointStride);
    const Lane3 x2 = load3(g.position + h[1] * kPointStride);
    const Lane3 x3 = load3(g.position + h[2] * kPointStride);
    const Lane3 x4 = load3(g.position + h[3] * kPointStride);
    const Lane3 edge = x4 - x3;
    const Lane3 n1 = cross(x1 - x3, x1 - x4), n2 = cross(x2 - x4, x2 - x3);
    const Lane s1 = dot(n1, n1), s2 = dot(n2, n2);
    const Lane length = lane_sqrt(dot(edge, edge)), inverse_length = 1.0 / length;
    const Lane inverse_norms = 1.0 / lane_sqrt(s1 * s2);
    const Lane cos_theta = dot(n1, n2) * inverse_norms;
    const Lane sin_theta = -dot(cross(n1, n2), edge) * inverse_length * inverse_norms;
    const FoldLaw law = hinge_law(cos_theta, sin_theta, t.rest_angle_cos[e], t.rest_angle_sin[e]);
    Lane moment = k * law.moment, slope = k * law.slope;
    if (sum_lanes<double>(lane_max0(kTouching.start - cos_theta)) > 0) {  // hardly ever
      const FoldLaw touch = barrier_law(kTouching, cos_theta, sin_theta);
      moment += touching * touch.moment;
      slope += touching * touch.slope;
    }
    const Lane stiffness = stiffness_scale * slope;
    const Lane root = lane_sqrt(stiffness);

    const Lane inverse_squares = inverse_norms * inverse_norms;
    const Lane inverse1 = s2 * inverse_squares, inverse2 = s1 * inverse_squares;  // of s1, s2
    const Lane end1 = dot(x1 - x4, edge) * inverse_length,
               end2 = dot(x2 - x4, edge) * inverse_length;
    const Lane3 a1 = inverse1 * n1, a2 = inverse2 * n2;
    const Lane3 grad1 = length * a1, grad2 = length * a2, grad3 = end1 * a1 + end2 * a2;
    const Lane3 f1 = -moment * grad1, f2 = -moment * grad2, f3 = -moment * grad3;
    add3(force + h[0] * kPointStride, f1);
    add3(force + h[1] * kPointStride, f2);
    add3(force + h[2] * kPointStride, f3);
    add3(force + h[3] * kPointStride, -(f1 + f2 + f3));  // the four gradients add up to zero
    store(element, root * length * inverse1);
    store(element + kLanes, root * length * inverse2);
    store(element + 2 * kLanes, root * end1 * inverse1);
    store(element + 3 * kLanes, root * end2 * inverse2);
    element += solve::kHingeStride;

    const auto& face = t.edge_triangle[e];
    const Lane least1 = least_area(face[0]), least2 = least_area(face[1]);
    const Lane missing =
        lane_max0(4.0 * least1 * least1 - s1) + lane_max0(4.0 * least2 * least2 - s2);
    if (sum_lanes<double>(missing) > 0)  // hardly ever
      add_collapses({k, stiffness_scale, {x1, x2, x3, x4}, n1, n2, s1, s2, least1, least2}, h,
                    force, spring);
    spring += solve::kSpringStride;
  }
}

}  // namespace

void add_bending(const Params& p, const GroupView& g, solve::System& s) {
  bending_kernel(p, g, s.stiffness_scale,
                 {s.force.data() + g.first_row * kPointStride,
                  s.hinge.data() + g.first_hinge * solve::kHingeStride,
                  s.spring.data() + g.first_spring * solve::kSpringStride});
}

namespace {
double squared_fold(const Barrier& barrier, double cos_theta) {
  const double u = 1 + cos_theta, open = std::max(u, barrier.floor);
  const double at_open = std::max(1 + barrier.start - open, 0.0) / open;
  const double fold = at_open + (1 + at_open) / open * (open - u);
  return fold * fold;
}
}  // namespace

double bending_energy(const Params& p, const GroupView& g, int lane) {
  const double touching = touch_stiffness(p, *g.topology) * g.radius[lane] * g.radius[lane];
  double energy = 0;
  for (std::size_t e = 0; e < g.topology->hinge.size(); ++e) {
    const auto& h = g.topology->hinge[e];
    Vec3 x[4];
    for (std::size_t m = 0; m < 4; ++m) x[m] = load_point(g.position, make_address(h[m], lane));
    const Vec3 edge = x[3] - x[2];
    const Vec3 n1 = (x[0] - x[2]).cross(x[0] - x[3]), n2 = (x[1] - x[3]).cross(x[1] - x[2]);
    const double theta = -std::atan2(n1.cross(n2).dot(edge) / edge.norm(), n1.dot(n2));
    const double rest = std::atan2(g.topology->rest_angle_sin[e], g.topology->rest_angle_cos[e]);
    energy += p.bending_stiffness *
                  (1 - std::cos(theta - rest) + squared_fold(kBending, std::cos(theta))) +
              touching * squared_fold(kTouching, std::cos(theta));
  }
  for (std::size_t f = 0; f < g.topology->triangle.size(); ++f) {
    const double least = kLeastArea * rest_triangle_area(g, f, lane);
    const double compression = std::max(least / triangle_area(g, f, lane) - 1, 0.0);
    energy += p.bending_stiffness * compression * compression;
  }
  return g.active[lane] * energy;
}

}  // namespace acinus::dcm
