#include "dcm/terms/bending.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::dcm {
namespace {

/// cos theta at which an edge begins to be a fold: 60 degrees between its faces.
constexpr double kFoldCos = -0.5;
/// 1 + cos theta below which the fold's energy bends off, so that all numbers stay finite: 11
/// degrees.
constexpr double kFoldFloor = 0.02;

ACINUS_KERNEL void bending_kernel(const Params& p, const GroupView& g, double stiffness_scale,
                                  double* force, float* element) {
  const mesh::Topology& t = *g.topology;
  const Lane k = p.bending_stiffness * load(g.active);
  for (int e = 0; e < t.n_edge; ++e) {
    const auto& h = t.hinge[static_cast<std::size_t>(e)];
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
    const double c0 = t.rest_angle_cos[static_cast<std::size_t>(e)];
    const double s0 = t.rest_angle_sin[static_cast<std::size_t>(e)];
    const Lane open = kFoldFloor + lane_max0(1.0 + cos_theta - kFoldFloor);
    const Lane inverse_open = 1.0 / open;
    const Lane fold = lane_max0(kFoldCos - cos_theta) * inverse_open;
    // d fold / d theta
    const Lane bends_off = 1.0 + cos_theta < kFoldFloor ? lane_of(0) : fold;
    const Lane slope = fold > 0.0 ? sin_theta * inverse_open * (1.0 + bends_off) : lane_of(0);
    const Lane moment = k * (sin_theta * c0 - cos_theta * s0 + 2.0 * fold * slope);
    const Lane stiffness =
        stiffness_scale * k * (lane_max0(cos_theta * c0 + sin_theta * s0) + 2.0 * slope * slope);
    const Lane root = lane_sqrt(stiffness);

    const Lane inverse_squares = inverse_norms * inverse_norms;
    const Lane3 a1 = (s2 * inverse_squares) * n1, a2 = (s1 * inverse_squares) * n2;
    const Lane3 grad1 = length * a1, grad2 = length * a2;
    const Lane3 grad3 =
        (dot(x1 - x4, edge) * inverse_length) * a1 + (dot(x2 - x4, edge) * inverse_length) * a2;
    const Lane3 f1 = -moment * grad1, f2 = -moment * grad2, f3 = -moment * grad3;
    add3(force + h[0] * kPointStride, f1);
    add3(force + h[1] * kPointStride, f2);
    add3(force + h[2] * kPointStride, f3);
    add3(force + h[3] * kPointStride, -(f1 + f2 + f3));  // the four gradients add up to zero
    store3(element, root * grad1);
    store3(element + 3 * kLanes, root * grad2);
    store3(element + 6 * kLanes, root * grad3);
    element += solve::kHingeStride;
  }
}

}  // namespace

void add_bending(const Params& p, const GroupView& g, solve::System& s) {
  bending_kernel(p, g, s.stiffness_scale, s.force.data() + g.first_row * kPointStride,
                 s.hinge.data() + g.first_hinge * solve::kHingeStride);
}

double bending_energy(const Params& p, const GroupView& g, int lane) {
  double energy = 0;
  for (std::size_t e = 0; e < g.topology->hinge.size(); ++e) {
    const auto& h = g.topology->hinge[e];
    Vec3 x[4];
    for (std::size_t m = 0; m < 4; ++m)
      x[m] = load_point(g.position, make_address(static_cast<std::size_t>(h[m]), lane));
    const Vec3 edge = x[3] - x[2];
    const Vec3 n1 = (x[0] - x[2]).cross(x[0] - x[3]), n2 = (x[1] - x[3]).cross(x[1] - x[2]);
    const double theta = -std::atan2(n1.cross(n2).dot(edge) / edge.norm(), n1.dot(n2));
    const double rest = std::atan2(g.topology->rest_angle_sin[e], g.topology->rest_angle_cos[e]);
    const double open = std::max(1 + std::cos(theta), kFoldFloor);
    const double fold = std::max(kFoldCos - std::cos(theta), 0.0) / open;
    energy += p.bending_stiffness * (1 - std::cos(theta - rest) + fold * fold);
  }
  return g.active[lane] * energy;
}

}  // namespace acinus::dcm
