#include "dcm/shape/split.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/sphere.hpp"
#include "dcm/shape/cast_half.hpp"
#include "dcm/shape/round_folds.hpp"
#include "geometry/measures.hpp"

namespace acinus::dcm {

namespace {

// Sum of the areas around each node times two: along the gradient of the volume.
std::vector<Vec3> make_area_vectors(const geometry::Topology& topology,
                                    std::span<const Vec3> node) {
  std::vector<Vec3> out(node.size(), Vec3::Zero());
  for (const auto& t : topology.triangle) {
    const Vec3& a = node[t[0]];
    const Vec3 part = (node[t[1]] - a).cross(node[t[2]] - a);
    for (const int i : t) out[i] += part;
  }
  return out;
}

// Cap nodes stay, rim nodes stay in the plane.
std::vector<Vec3> make_outset(const geometry::Topology& topology, std::span<const Vec3> node,
                              const std::vector<Part>& part, const Vec3& normal) {
  std::vector<Vec3> out = make_area_vectors(topology, node);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (part[i] == Part::kRim) out[i] -= normal * normal.dot(out[i]);
    out[i] = part[i] == Part::kCap ? Vec3::Zero() : Vec3(out[i].normalized());
  }
  return out;
}

// The loop of the lower half turned round, from the same first point: with the opposite turn the
// ring nodes of both halves coincide.
std::vector<Vec3> reverse_loop(std::vector<Vec3> loop) {
  std::reverse(loop.begin() + 1, loop.end());
  return loop;
}

}  // namespace

std::optional<double> match_volume_along(const geometry::Topology& topology, double target_volume,
                                         std::span<const Vec3> direction, std::span<Vec3> node) {
  if (!(target_volume > 0)) return std::nullopt;
  const double limit = 0.1 * sphere_radius(target_volume);
  std::vector<Vec3> moved(node.begin(), node.end());
  double step = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double excess = geometry::compute_volume(moved, topology.triangle) - target_volume;
    if (std::abs(excess) <= 1e-12 * target_volume) {
      std::copy(moved.begin(), moved.end(), node.begin());
      return step;
    }
    const std::vector<Vec3> area_vector = make_area_vectors(topology, moved);
    double slope = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) slope += area_vector[i].dot(direction[i]) / 6;
    step -= excess / slope;
    if (!(std::abs(step) <= limit)) return std::nullopt;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = node[i] + step * direction[i];
  }
  return std::nullopt;
}

bool match_volume(const geometry::Topology& topology, double target_volume,
                  std::span<const double> weight, std::span<Vec3> node) {
  std::vector<Vec3> direction = make_area_vectors(topology, node);
  for (std::size_t i = 0; i < direction.size(); ++i)
    direction[i] = weight[i] * direction[i].normalized();
  return match_volume_along(topology, target_volume, direction, node).has_value();
}

Split split_cell(const geometry::Topology& topology, std::span<const Vec3> node, const Vec3& normal,
                 double thickness, double turn) {
  const auto plane = geometry::find_halving_plane(node, topology.triangle, normal);
  if (!plane) return {std::nullopt, SplitFailure::kNoHalving};
  const geometry::Cut cut = geometry::cut_surface(node, topology.triangle, *plane);
  if (cut.loop.size() != 1) return {std::nullopt, SplitFailure::kSeveralLoops};

  DaughterShapes out;
  out.plane = *plane;
  out.rim = cut.loop[0];
  out.part = make_parts(topology);
  const double target = geometry::compute_volume(node, topology.triangle) / 2;
  for (std::size_t h = 0; h < 2; ++h) {
    auto half = h == 0 ? cast_half(topology, cut.half[0], out.rim, turn)
                       : cast_half(topology, cut.half[1], reverse_loop(out.rim), -turn);
    if (!half) return {std::nullopt, SplitFailure::kNotStarShaped};
    round_folds(topology, thickness, half->node);
    out.chord_loss[h] = 1 - geometry::compute_volume(half->node, topology.triangle) / target;
    const auto outset = match_volume_along(
        topology, target, make_outset(topology, half->node, out.part, normal), half->node);
    if (!outset || !faces_outward(topology, half->node, half->center))
      return {std::nullopt, SplitFailure::kNoVolume};
    out.outset[h] = *outset;
    out.node[h] = std::move(half->node);
  }
  return {std::move(out), SplitFailure::kNone};
}

}  // namespace acinus::dcm
