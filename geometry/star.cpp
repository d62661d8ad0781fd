#include "geometry/star.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/sphere.hpp"
#include "geometry/closed.hpp"
#include "geometry/measures.hpp"

namespace acinus::geometry {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct FacePlane {
  Vec3 normal = Vec3::Zero();  // outward
  double offset = 0;
};

std::vector<FacePlane> make_planes(const Surface& surface) {
  // Slivers below this part of the squared size have no reliable normal; their neighbours speak.
  constexpr double kNoArea = 1e-13;
  Vec3 low = surface.node.at(0), high = low;
  for (const Vec3& x : surface.node) low = low.cwiseMin(x), high = high.cwiseMax(x);
  std::vector<FacePlane> out;
  for (const auto& t : surface.triangle) {
    const Vec3& a = surface.node[t[0]];
    const Vec3& b = surface.node[t[1]];
    const Vec3& c = surface.node[t[2]];
    const Vec3 twice_area = (b - a).cross(c - a);
    const double size = twice_area.norm();
    if (!(size > kNoArea * (high - low).squaredNorm())) continue;
    const Vec3 normal = twice_area / size;
    out.push_back({normal, normal.dot((a + b + c) / 3)});
  }
  return out;
}

struct Nearest {
  double margin = kInfinity;
  Vec3 normal = Vec3::Zero();
};

Nearest find_nearest(const std::vector<FacePlane>& planes, const Vec3& point) {
  Nearest out;
  for (const auto& [normal, offset] : planes) {
    const double margin = offset - normal.dot(point);
    if (margin < out.margin) out = {margin, normal};
  }
  return out;
}

}  // namespace

double compute_star_margin(const Surface& surface, const Vec3& point) {
  return find_nearest(make_planes(surface), point).margin;
}

std::optional<Vec3> find_star_center(const Surface& surface) {
  constexpr double kMargin = 0.01;
  const double volume = compute_volume(surface.node, surface.triangle);
  if (!(volume > 0)) return std::nullopt;
  const double radius = sphere_radius(volume);
  const std::vector<FacePlane> planes = make_planes(surface);
  const Vec3 centroid = compute_centroid(surface.node, surface.triangle);
  if (find_nearest(planes, centroid).margin >= kMargin * radius) return centroid;
  // The deeper the better, but no point may be as deep as that.
  for (const double depth : {0.1, 0.03, kMargin}) {
    Vec3 point = centroid;
    for (int iteration = 0; iteration < 200; ++iteration) {
      const auto [margin, normal] = find_nearest(planes, point);
      if (margin >= depth * radius) return point;
      point -= 1.5 * (depth * radius - margin) * normal;
    }
  }
  return std::nullopt;
}

StarSurface::StarSurface(const Surface& surface, const Vec3& center)
    : center_(center), face_(surface.triangle.size()) {
  for (std::size_t t = 0; t < face_.size(); ++t) {
    Face& face = face_[t];
    for (std::size_t k = 0; k < 3; ++k)
      face.corner[k] = surface.node[surface.triangle[t][k]] - center;
    for (std::size_t k = 0; k < 3; ++k)
      face.side[k] = face.corner[(k + 1) % 3].cross(face.corner[(k + 2) % 3]);
    face.normal =
        (face.corner[1] - face.corner[0]).cross(face.corner[2] - face.corner[0]).normalized();
  }
  const std::vector<HalfEdge> half = make_half_edges(surface.triangle);
  for (std::size_t e = 0; e + 1 < half.size(); e += 2) {
    for (const auto& [mine, other] : {std::pair{e, e + 1}, std::pair{e + 1, e}}) {
      const std::size_t t = half[mine].triangle;
      const auto& corner = surface.triangle[t];
      const auto k = std::find(corner.begin(), corner.end(), half[mine].opposite) - corner.begin();
      face_[t].neighbour[k] = half[other].triangle;
    }
  }
}

Hit StarSurface::make_hit(const Vec3& weight, std::size_t face) const {
  const Vec3 w = weight.cwiseMax(0.0) / weight.cwiseMax(0.0).sum();
  const auto& corner = face_[face].corner;
  return {center_ + w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2], static_cast<int>(face)};
}

// direction = sum_k weight_k corner_k up to a positive factor, with weight_k = direction . side_k:
// the ray meets the face where no weight is negative.
Hit StarSurface::cast(const Vec3& direction, int start) const {
  int at = start, last = -1;
  for (std::size_t step = 0; step < face_.size(); ++step) {
    const Face& face = face_[at];
    const Vec3 weight(direction.dot(face.side[0]), direction.dot(face.side[1]),
                      direction.dot(face.side[2]));
    int k = 0;
    const double least = weight.minCoeff(&k);
    const int next = face.neighbour[k];
    if (least >= 0 || next == last) {  // sent back: the ray runs along the side between the two
      if (!(weight.sum() > 0)) break;
      return make_hit(weight, at);
    }
    last = at;
    at = next;
  }
  return cast_to_nearest(direction);  // a face of no area, or the walk went in a circle
}

// The face the ray is least outside of.
Hit StarSurface::cast_to_nearest(const Vec3& direction) const {
  double best = -kInfinity;
  Vec3 best_weight = Vec3::UnitX();
  std::size_t at = 0;
  for (std::size_t f = 0; f < face_.size(); ++f) {
    const auto& side = face_[f].side;
    const Vec3 weight(direction.dot(side[0]), direction.dot(side[1]), direction.dot(side[2]));
    if (!(weight.sum() > 0)) continue;
    const double inside = weight.minCoeff() / weight.cwiseAbs().sum();
    if (inside <= best) continue;
    best = inside;
    best_weight = weight;
    at = f;
  }
  return make_hit(best_weight, at);
}

}  // namespace acinus::geometry
