#include "dcm/terms/volume.hpp"

#include <algorithm>
#include <cmath>

#include "dcm/terms/rank_one.hpp"

namespace acinus::dcm {
namespace {

/// Ratio to V0 below which the pressure of a collapsing cell no longer rises.
constexpr double kSmallestVolume = 1e-3;

/// Adds dV/dx to `gradient` and writes V. Coordinates are taken from node 0 to keep digits.
ACINUS_KERNEL void volume_kernel(const GroupView& g, double* gradient, double* volume) {
  const Lane3 origin = load3(g.position);
  Lane v = lane_of(0);
  for (const auto& f : g.topology->triangle) {
    const Lane3 a = load3(g.position + f[0] * kPointStride) - origin;
    const Lane3 b = load3(g.position + f[1] * kPointStride) - origin;
    const Lane3 c = load3(g.position + f[2] * kPointStride) - origin;
    const Lane3 bc = cross(b, c);
    v += dot(a, bc) * (1.0 / 6);
    if (!gradient) continue;
    const Lane sixth = lane_of(1.0 / 6);
    add3(gradient + f[0] * kPointStride, sixth * bc);
    add3(gradient + f[1] * kPointStride, sixth * cross(c, a));
    add3(gradient + f[2] * kPointStride, sixth * cross(a, b));
  }
  store(volume, v);
}

}  // namespace

void add_volume(const Params& p, const GroupView& g, solve::System& s, solve::RankOne& family) {
  double* const gradient = zero_gradient(g.topology->n_node);
  double volume[kLanes], pressure[kLanes];
  volume_kernel(g, gradient, volume);
  round_gradient(g.topology->n_node, gradient, family.vector.data() + g.first_row * kPointStride);
  for (int l = 0; l < kLanes; ++l) {
    const double v0 = 4.0 / 3 * kPi * g.radius[l] * g.radius[l] * g.radius[l];
    const double v = std::max(volume[l], kSmallestVolume * v0);
    pressure[l] = g.active[l] * cytosol_pressure(p.bulk_modulus, v, v0);
    family.coefficient[g.index * kLanes + l] = s.stiffness_scale * g.active[l] * p.bulk_modulus / v;
  }
  add_scaled(g.topology->n_node, pressure, gradient, s.force.data() + g.first_row * kPointStride);
}

Lane compute_volumes(const GroupView& g) {
  double volume[kLanes];
  volume_kernel(g, nullptr, volume);
  return load(volume);
}

double volume_energy(const Params& p, const GroupView& g, int lane) {
  const double v = compute_volumes(g)[lane];
  const double v0 = 4.0 / 3 * kPi * g.radius[lane] * g.radius[lane] * g.radius[lane];
  // Below the bound the pressure is constant, so the energy is linear in the volume.
  const double bound = std::max(v, kSmallestVolume * v0);
  const double energy = p.bulk_modulus * (bound * std::log(bound / v0) - bound + v0);
  return g.active[lane] * (energy + cytosol_pressure(p.bulk_modulus, bound, v0) * (bound - v));
}

}  // namespace acinus::dcm
