#include "dcm/terms/local_area.hpp"

namespace acinus::dcm {
namespace {

ACINUS_KERNEL void local_area_kernel(const Params& p, const GroupView& g, double stiffness_scale,
                                     double* force, float* element) {
  const geometry::Topology& t = *g.topology;
  const Lane k = p.local_area_modulus * load(g.active);
  const Lane radius = load(g.radius);
  for (std::size_t f = 0; f < t.triangle.size(); ++f) {
    const auto& corner = t.triangle[f];
    const Lane3 x0 = load3(g.position + corner[0] * kPointStride);
    const Lane3 x1 = load3(g.position + corner[1] * kPointStride);
    const Lane3 x2 = load3(g.position + corner[2] * kPointStride);
    const Lane3 c = cross(x1 - x0, x2 - x0);
    const Lane norm = lane_sqrt(dot(c, c));
    const Lane3 half_normal = (0.5 / norm) * c;
    const Lane3 grad[3] = {cross(half_normal, x2 - x1), cross(half_normal, x0 - x2),
                           cross(half_normal, x1 - x0)};
    Lane a0 = t.rest_triangle_area[f] * radius * radius;
    if (g.triangle) a0 = a0 * load(g.triangle + f * kLanes);
    const Lane pull = -k * (0.5 * norm - a0) / a0;
    const Lane root = lane_sqrt(stiffness_scale * k / a0);
    for (std::size_t m = 0; m < 3; ++m) add3(force + corner[m] * kPointStride, pull * grad[m]);
    for (int m = 0; m < 2; ++m) store3(element + 3 * m * kLanes, root * grad[m]);
    element += solve::kFaceStride;
  }
}

}  // namespace

void add_local_area(const Params& p, const GroupView& g, solve::System& s) {
  local_area_kernel(p, g, s.stiffness_scale, s.force.data() + g.first_row * kPointStride,
                    s.face.data() + g.first_face * solve::kFaceStride);
}

double local_area_energy(const Params& p, const GroupView& g, int lane) {
  double energy = 0;
  for (std::size_t f = 0; f < g.topology->triangle.size(); ++f) {
    const double a0 = rest_triangle_area(g, f, lane);
    const double stretch = triangle_area(g, f, lane) - a0;
    energy += p.local_area_modulus * stretch * stretch / (2 * a0);
  }
  return g.active[lane] * energy;
}

}  // namespace acinus::dcm
