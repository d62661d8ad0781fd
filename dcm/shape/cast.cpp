#include "dcm/shape/cast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/measures.hpp"

namespace acinus::dcm {

namespace {

// Weights of a sweep, chosen by trial on spheres, ellipsoids, crescents and polyhedra: even sweeps
// first, more of them where the mesh is far from even, then gentler ones in which ridges win over
// evenness. The first kind may spoil a triangle down to a low quality, or strongly stretched meshes
// would lock.
struct Sweep {
  double even = 0;     // part of the way to the centroid of the triangles around
  double uphill = 0;   // step up in volume, per slope and length
  double quality = 0;  // triangles above this may become worse
  int least = 0, most = 0;
};
constexpr std::array<Sweep, 2> kCastSweeps = {{{1.0, 0.35, 0.2, 5, 30}, {0.25, 0.25, 0.7, 10, 10}}};
constexpr double kSettled = 0.08;  // mean move, part of the mean edge

class Spreader {
 public:
  Spreader(const geometry::Topology& topology, const geometry::StarSurface& star,
           const SpreadRule& rule, std::span<Vec3> node)
      : topology_(topology), star_(star), rule_(rule), node_(node), face_(node.size(), 0) {
    for (const auto& [i, j] : topology.edge)
      length_ += (node[i] - node[j]).norm() / topology.n_edge;
    int at = 0;
    for (std::size_t i = 0; i < node.size(); ++i)
      if (rule.part[i] == Part::kShell)
        face_[i] = at = star.cast(node[i] - star.center(), at).triangle;
  }

  // Moves a node; returns the distance as part of the mean edge.
  double move(int node, const Sweep& sweep) {
    const std::size_t i = node;
    if (rule_.part[i] == Part::kRim) return 0;
    geometry::Hit to{make_target(node, sweep), face_[i]};
    if (rule_.part[i] == Part::kShell) {
      to = star_.cast(to.point - star_.center(), face_[i]);
      if (to.triangle >= rule_.n_shell_face) return 0;
    }
    const double quality = worst_quality(node, to.point);
    if (!(quality > 0)) return 0;
    if (quality < sweep.quality && quality < worst_quality(node, node_[i])) return 0;
    const double distance = (to.point - node_[i]).norm();
    node_[i] = to.point;
    face_[i] = to.triangle;
    return distance / length_;
  }

 private:
  std::span<const int> triangles_around(int node) const {
    const std::size_t i = node;
    const std::size_t first = topology_.node_triangle_start[i];
    const std::size_t end = topology_.node_triangle_start[i + 1];
    return std::span(topology_.node_triangle).subspan(first, end - first);
  }

  // The volume is linear in the place of one node; its slope is the area vector around it.
  Vec3 make_target(int node, const Sweep& sweep) const {
    Vec3 moment = Vec3::Zero(), area_vector = Vec3::Zero();
    double area = 0;
    for (const int t : triangles_around(node)) {
      const auto& corner = topology_.triangle[t];
      const Vec3& a = node_[corner[0]];
      const Vec3& b = node_[corner[1]];
      const Vec3& c = node_[corner[2]];
      const Vec3 part = (b - a).cross(c - a) / 2;
      const double size = part.norm();
      area_vector += part;
      area += size;
      moment += size * (a + b + c) / 3;
    }
    const std::size_t i = node;
    const Vec3& x = node_[i];
    Vec3 target = x + sweep.even * (moment / area - x);
    if (rule_.part[i] == Part::kShell) {
      const Vec3 upward = area_vector.normalized(), normal = star_.normal(face_[i]);
      target += sweep.uphill * std::sqrt(area) * (upward - normal * normal.dot(upward));
    }
    return target;
  }

  // Worst quality of the triangles around a node placed at x; negative if one is inverted.
  double worst_quality(int node, const Vec3& x) const {
    double worst = 1;
    for (const int t : triangles_around(node)) {
      std::array<Vec3, 3> v;
      for (std::size_t k = 0; k < 3; ++k) {
        const int corner = topology_.triangle[t][k];
        v[k] = (corner == node ? x : node_[corner]) - star_.center();
      }
      const double quality = geometry::compute_triangle_quality(v[0], v[1], v[2]);
      worst = std::min(worst, v[0].dot(v[1].cross(v[2])) > 0 ? quality : -1.0);
    }
    return worst;
  }

  const geometry::Topology& topology_;
  const geometry::StarSurface& star_;
  const SpreadRule& rule_;
  std::span<Vec3> node_;
  double length_ = 0;      // mean edge
  std::vector<int> face_;  // [n_node] the face under a shell node
};

}  // namespace

std::optional<std::vector<Vec3>> cast_sphere(const geometry::Topology& topology,
                                             const geometry::Surface& surface, const Vec3& center,
                                             const Mat3& rotation) {
  if (!(geometry::compute_star_margin(surface, center) > 0)) return std::nullopt;
  const geometry::StarSurface star(surface, center);
  std::vector<Vec3> out;
  int at = 0;
  for (const Vec3& rest : topology.rest) {
    const geometry::Hit hit = star.cast(rotation * rest, at);
    at = hit.triangle;
    out.push_back(hit.point);
  }
  return out;
}

bool faces_outward(const geometry::Topology& topology, std::span<const Vec3> node,
                   const Vec3& center) {
  const auto is_outward = [&](const std::array<int, 3>& t) {
    const Vec3 a = node[t[0]] - center;
    const Vec3 b = node[t[1]] - center;
    const Vec3 c = node[t[2]] - center;
    return a.dot(b.cross(c)) > 0;
  };
  // A surface wound twice round the centre passes the first test.
  return std::all_of(topology.triangle.begin(), topology.triangle.end(), is_outward) &&
         geometry::compute_winding_number(center, node, topology.triangle) < 1.5;
}

void spread_nodes(const geometry::Topology& topology, const geometry::StarSurface& star,
                  const SpreadRule& rule, std::span<Vec3> node) {
  Spreader spreader(topology, star, rule, node);
  for (const Sweep& sweep : kCastSweeps) {
    for (int repeat = 0; repeat < sweep.most; ++repeat) {
      double moved = 0;
      for (int i = 0; i < topology.n_node; ++i) moved += spreader.move(i, sweep);
      if (repeat + 1 >= sweep.least && moved < kSettled * topology.n_node) break;
    }
  }
}

std::optional<std::vector<Vec3>> cast_and_spread(const geometry::Topology& t,
                                                 const geometry::Surface& surface,
                                                 const Vec3& center, const Mat3& rotation) {
  std::optional<std::vector<Vec3>> node = cast_sphere(t, surface, center, rotation);
  if (!node) return std::nullopt;
  const std::vector<Part> part(node->size(), Part::kShell);
  spread_nodes(t, geometry::StarSurface(surface, center),
               {part, static_cast<int>(surface.triangle.size())}, *node);
  return node;
}

}  // namespace acinus::dcm
