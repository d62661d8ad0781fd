#include "runs/experiments/open_area.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::runs {
namespace {

constexpr double kAngle = kPi / 180, kSlice = 4, kStep = 2;  // rad, um, um

void mark_vessels(const geometry::Network& network, LesionGrid& g) {
  const std::vector<Box> boxes = segment_boxes(network);
  auto free = g.free.begin();
  for (const double z : g.height)
    for (const Vec2& ray : g.ray) {
      const Vec3 along(ray.x(), ray.y(), 0), foot(g.axis.x(), g.axis.y(), z);
      Box box;
      box.include(foot);
      box.include(foot + g.to_radius * along);
      for (std::size_t s = 0; s < boxes.size(); ++s) {
        if (!boxes[s].overlaps(box)) continue;
        for (int k = 0; k < g.n_radius; ++k) {
          const Vec3 x = foot + (g.from_radius + (k + 0.5) * g.radius_step) * along;
          if (contact::gap_to_segment(network, static_cast<int>(s), x).gap < 0) free[k] = 0;
        }
      }
      free += g.n_radius;
    }
}

}  // namespace

std::vector<Box> segment_boxes(const geometry::Network& n) {
  std::vector<Box> boxes;
  for (std::size_t s = 0; s < n.segment.size(); ++s) {
    Box box;
    for (const int i : n.segment[s]) box.include(n.node[i]);
    boxes.push_back(box.grown(std::max(n.radius[s][0], n.radius[s][1])));
  }
  return boxes;
}

LesionGrid make_lesion_grid(const LobuleDomain& lobule, double lesion_radius,
                            const geometry::Network& vessels) {
  LesionGrid g;
  g.axis = lobule.axis;
  g.from_radius = lobule.frame.vein_radius;
  g.to_radius = std::max(lesion_radius, g.from_radius);
  g.cap = g.to_radius + 2 * lobule.frame.cell_radius;
  const double turn = lobule.to_angle - lobule.from_angle;
  const int n_ray = std::max(1, static_cast<int>(std::lround(turn / kAngle)));
  g.angle_step = turn / n_ray;
  for (int k = 0; k < n_ray; ++k) {
    const double angle = lobule.from_angle + (k + 0.5) * g.angle_step;
    g.ray.emplace_back(std::cos(angle), std::sin(angle));
  }
  g.height =
      slice_heights(lobule.frame.height,
                    std::max(1, static_cast<int>(std::lround(lobule.frame.height / kSlice))));
  g.n_radius = static_cast<int>(std::ceil((g.to_radius - g.from_radius) / kStep));
  g.radius_step = g.n_radius > 0 ? (g.to_radius - g.from_radius) / g.n_radius : kStep;
  g.free.assign(g.height.size() * g.ray.size() * static_cast<std::size_t>(g.n_radius), 1);
  mark_vessels(vessels, g);
  return g;
}

Opening measure_opening(const LesionGrid& g, const std::vector<Section>& sections) {
  const Vec2 axis = g.axis.head<2>();
  const double slices = static_cast<double>(sections.size());
  Opening o;
  double square = 0;
  auto free = g.free.begin();
  for (const Section& section : sections)
    for (const Vec2& ray : g.ray) {
      const std::vector<Chord> pieces = covered_pieces(section, axis, ray, 0);
      double first = g.cap;
      for (const Chord& c : pieces)
        if (c[1] > 0) {
          first = std::clamp(c[0], 0.0, g.cap);
          break;
        }
      o.front += first;
      square += first * first;
      const double seen = std::clamp(first, g.from_radius, g.to_radius);
      o.seen += 0.5 * g.angle_step * (seen * seen - g.from_radius * g.from_radius) / slices;
      auto piece = pieces.begin();
      for (int k = 0; k < g.n_radius; ++k, ++free) {
        const double r = g.from_radius + (k + 0.5) * g.radius_step;
        while (piece != pieces.end() && (*piece)[1] < r) ++piece;
        const bool covered = piece != pieces.end() && (*piece)[0] <= r;
        if (*free != 0 && !covered) o.area += r * g.radius_step * g.angle_step / slices;
      }
    }
  const double rays = slices * static_cast<double>(g.ray.size());
  o.front /= rays;
  o.roughness = std::sqrt(std::max(0.0, square / rays - o.front * o.front));
  return o;
}

}  // namespace acinus::runs
