#include "dcm/shape/cast_half.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace acinus::dcm {

namespace {

// Number of parts of an icosahedron edge, 0 if the mesh is no icosphere.
int count_edge_parts(const geometry::Topology& topology) {
  for (int parts = 1; parts <= 16; ++parts)
    if (topology.n_node == 10 * parts * parts + 2) return parts;
  return 0;
}

// Number of edges between each node and node 0.
std::vector<int> count_edges_to_pole(const geometry::Topology& topology) {
  std::vector<int> distance(topology.n_node, -1), queue = {0};
  distance[0] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::size_t i = queue[head];
    for (int k = topology.ring_start[i]; k < topology.ring_start[i + 1]; ++k) {
      const int next = topology.ring[k];
      if (distance[next] >= 0) continue;
      distance[next] = distance[i] + 1;
      queue.push_back(next);
    }
  }
  return distance;
}

// Position of a node between the pole, the ring and the opposite pole.
struct RingPlace {
  double around = 0;  // along the ring, 0 to 1
  double depth = 0;   // cap: 0 pole, 1 ring; shell: 0 ring, 1 opposite pole
};

// The rest shape in polar coordinates about the pole, one ring node at azimuth zero.
struct Polar {
  double azimuth = 0, angle = 0;
};

std::vector<Polar> make_polar(const geometry::Topology& topology, const std::vector<Part>& part) {
  const Vec3 pole = topology.rest[0].normalized();
  const auto first = std::find(part.begin(), part.end(), Part::kRim) - part.begin();
  const Vec3 to_first = topology.rest[first];
  const Vec3 x = (to_first - pole * pole.dot(to_first)).normalized(), y = pole.cross(x);
  std::vector<Polar> out;
  for (const Vec3& rest : topology.rest) {
    const Vec3 d = rest.normalized();
    double azimuth = std::atan2(d.dot(y), d.dot(x));
    if (azimuth < -1e-9) azimuth += 2 * kPi;  // not the first ring node itself
    out.push_back({azimuth, std::acos(std::clamp(d.dot(pole), -1.0, 1.0))});
  }
  return out;
}

std::vector<RingPlace> make_places(const geometry::Topology& topology,
                                   const std::vector<Part>& part) {
  const std::vector<Polar> polar = make_polar(topology, part);
  std::vector<Polar> ring;
  for (std::size_t i = 0; i < part.size(); ++i)
    if (part[i] == Part::kRim) ring.push_back(polar[i]);
  std::sort(ring.begin(), ring.end(),
            [](const Polar& a, const Polar& b) { return a.azimuth < b.azimuth; });
  const std::size_t n_ring = ring.size();
  ring.push_back({ring[0].azimuth + 2 * kPi, ring[0].angle});

  std::vector<RingPlace> out;
  for (std::size_t i = 0; i < part.size(); ++i) {
    std::size_t k = 0;  // the side of the ring that faces the node
    while (k + 1 < n_ring && ring[k + 1].azimuth <= polar[i].azimuth + 1e-9) ++k;
    const double along =
        (polar[i].azimuth - ring[k].azimuth) / (ring[k + 1].azimuth - ring[k].azimuth);
    const double angle = ring[k].angle + along * (ring[k + 1].angle - ring[k].angle);
    RingPlace place;
    place.around = (static_cast<double>(k) + along) / static_cast<double>(n_ring);
    if (part[i] == Part::kCap) place.depth = polar[i].angle / angle;
    if (part[i] == Part::kShell) place.depth = (polar[i].angle - angle) / (kPi - angle);
    out.push_back(place);
  }
  return out;
}

// Closed polygon, parametrised by its length.
class Polygon {
 public:
  explicit Polygon(std::span<const Vec3> point) : point_(point), length_{0} {
    for (std::size_t k = 0; k < point.size(); ++k)
      length_.push_back(length_.back() + (point[(k + 1) % point.size()] - point[k]).norm());
  }

  Vec3 at(double part) const {
    const double s = (part - std::floor(part)) * length_.back();
    const auto after = std::upper_bound(length_.begin() + 1, length_.end() - 1, s);
    const auto k = static_cast<std::size_t>(after - length_.begin()) - 1;
    const double size = length_[k + 1] - length_[k];
    const Vec3& from = point_[k];
    const Vec3& to = point_[(k + 1) % point_.size()];
    return size > 0 ? Vec3(from + std::min(1.0, (s - length_[k]) / size) * (to - from)) : from;
  }

 private:
  std::span<const Vec3> point_;
  std::vector<double> length_;  // [n_point + 1] up to each point
};

Vec3 compute_cap_center(std::span<const Vec3> rim) {
  Vec3 normal = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < rim.size(); ++k)
    normal += (rim[k] - rim[0]).cross(rim[k + 1] - rim[0]);
  for (std::size_t k = 1; k + 1 < rim.size(); ++k)
    moment += (rim[k] - rim[0]).cross(rim[k + 1] - rim[0]).dot(normal) *
              ((rim[k] - rim[0]) + (rim[k + 1] - rim[0])) / 3;
  return rim[0] + moment / normal.squaredNorm();
}

// Turns `from` by `part` of its angle to `to`; both of length 1.
Vec3 turn_towards(const Vec3& from, const Vec3& to, double part) {
  const Vec3 across = (to - from * from.dot(to)).normalized();
  const double angle = part * std::acos(std::clamp(from.dot(to), -1.0, 1.0));
  return std::cos(angle) * from + std::sin(angle) * across;
}

}  // namespace

std::vector<Part> make_parts(const geometry::Topology& topology) {
  const int n_part = count_edge_parts(topology);
  check(
      n_part > 0 && topology.ring_start[1] == 5,
      fmt::format("cells that divide need an icosphere, as of 42, 162 or 642 nodes, but this mesh "
                  "has {} nodes. Choose one of these.",
                  topology.n_node));
  std::vector<Part> out;
  for (const int distance : count_edges_to_pole(topology))
    out.push_back(distance < n_part ? Part::kCap : distance == n_part ? Part::kRim : Part::kShell);
  return out;
}

std::optional<HalfMesh> cast_half(const geometry::Topology& topology, const geometry::Surface& half,
                                  std::span<const Vec3> rim, double turn) {
  const std::optional<Vec3> center = geometry::find_star_center(half);
  if (!center) return std::nullopt;
  const geometry::StarSurface star(half, *center);
  const std::vector<Part> part = make_parts(topology);
  const SpreadRule rule{part, static_cast<int>(half.triangle.size() - (rim.size() - 2))};
  const Polygon curve(rim);
  const Vec3 cap_center = compute_cap_center(rim);
  const Vec3 opposite = (*center - cap_center).normalized();

  HalfMesh out;
  out.center = *center;
  int face = 0;
  const std::vector<RingPlace> places = make_places(topology, part);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 on_rim = curve.at(places[i].around + turn);
    if (part[i] != Part::kShell) {
      const double outward = part[i] == Part::kRim ? 1 : places[i].depth;
      out.node.push_back(outward == 1 ? on_rim
                                      : Vec3(cap_center + outward * (on_rim - cap_center)));
      continue;
    }
    const Vec3 to_rim = (on_rim - *center).normalized();
    const geometry::Hit hit = star.cast(turn_towards(to_rim, opposite, places[i].depth), face);
    if (hit.triangle >= rule.n_shell_face) return std::nullopt;
    face = hit.triangle;
    out.node.push_back(hit.point);
  }
  if (!faces_outward(topology, out.node, *center)) return std::nullopt;
  spread_nodes(topology, star, rule, out.node);
  if (!faces_outward(topology, out.node, *center)) return std::nullopt;
  return out;
}

}  // namespace acinus::dcm
