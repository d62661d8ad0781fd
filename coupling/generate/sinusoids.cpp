#include "coupling/generate/sinusoids.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/parallel/disjoint_sets.hpp"
#include "coupling/generate/buckets.hpp"

namespace acinus::coupling {
namespace {

constexpr double kWallSpacing = 12;     // um of z between wall nodes of one vein
constexpr double kVeinClearance = 2;    // um between a vein's wall and the nearest branch point
constexpr double kLongestExtra = 45;    // um, edges beyond the spanning tree
constexpr int kMaxDegree = 4;           // sinusoids at a branch point
constexpr double kRadialBias = 0.6;     // extra cost of an edge across the flow
constexpr double kDiskFraction = 0.78;  // disk distance in units of density^(-1/3)
constexpr int kMaxMisses = 100000;      // rejected darts in a row that end the sampling

struct Edge {
  int a, b;
  double length, cost;
  bool through_vein;
};

void add_branch_points(const LobuleParameters& p, const Domain& domain, const Uniform& uniform,
                       std::vector<Vec3>& node) {
  const std::size_t wanted = std::lround(p.branch_density * domain.volume);
  const double distance = kDiskFraction / std::cbrt(p.branch_density);
  Buckets taken(distance);
  for (int misses = 0; node.size() < wanted && misses < kMaxMisses; ++misses) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = domain.low[axis] + uniform() * (domain.high[axis] - domain.low[axis]);
    if (depth_inside(domain, point) < 0 || taken.any_within(point, distance)) continue;
    const bool near_vein = std::any_of(domain.vein.begin(), domain.vein.end(), [&](const Vein& v) {
      return axis_distance(v, point) < v.radius + kVeinClearance;
    });
    if (near_vein) continue;
    taken.add(point, point);
    node.push_back(point);
    misses = 0;
  }
}

/// Vein of each node, -1 for branch points.
std::vector<int> add_wall_nodes(const Domain& domain, std::vector<Vec3>& node) {
  std::vector<int> vein_of(node.size(), -1);
  for (std::size_t v = 0; v < domain.vein.size(); ++v) {
    const Vein& vein = domain.vein[v];
    int level = 0;
    for (double z = kWallSpacing / 2; z < domain.height; z += kWallSpacing, ++level)
      for (const double angle : vein.wall_angle[level % 2]) {
        node.push_back(vein.axis +
                       Vec3(vein.radius * std::cos(angle), vein.radius * std::sin(angle), z));
        vein_of.push_back(static_cast<int>(v));
      }
  }
  return vein_of;
}

/// Smallest horizontal distance of a segment from the axis of a vein, um.
double axis_distance(const Vein& vein, Vec3 a, Vec3 b) {
  a.z() = b.z() = 0;
  return distance_to_segment(vein.axis, a, b);
}

std::vector<Edge> delaunay_edges(const std::vector<Vec3>& node, const std::vector<int>& vein_of,
                                 const Domain& domain) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
  using Delaunay =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex>>;
  std::vector<std::pair<Kernel::Point_3, int>> input;
  for (std::size_t i = 0; i < node.size(); ++i)
    input.emplace_back(Kernel::Point_3(node[i].x(), node[i].y(), node[i].z()), static_cast<int>(i));
  const Delaunay delaunay(input.begin(), input.end());
  std::vector<Edge> edge;
  for (const auto& [cell, i, j] : delaunay.finite_edges()) {
    const auto [a, b] = std::minmax(cell->vertex(i)->info(), cell->vertex(j)->info());
    if (vein_of[a] >= 0 && vein_of[b] >= 0) continue;  // the vein itself joins its wall nodes
    const Vec3 along = node[b] - node[a];
    Vec3 radial = (node[a] + node[b]) / 2 - domain.vein.front().axis;
    radial.z() = 0;
    const double length = along.norm();
    const double cosine = std::abs(along.dot(radial)) / (length * radial.norm());
    bool through = false;
    for (const Vein& vein : domain.vein)  // wall nodes are on the wall: allow for round-off
      through = through || axis_distance(vein, node[a], node[b]) < (1 - 1e-6) * vein.radius;
    edge.push_back({a, b, length, length * (1 + kRadialBias * (1 - cosine)), through});
  }
  std::sort(edge.begin(), edge.end(), [](const Edge& l, const Edge& r) {
    return std::tie(l.through_vein, l.cost, l.a, l.b) < std::tie(r.through_vein, r.cost, r.a, r.b);
  });
  return edge;
}

/// Selection of edges, with degrees, connected parts and total length.
class Builder {
 public:
  Builder(const std::vector<int>& vein_of, Sinusoids& out)
      : vein_of_(vein_of), out_(out), degree_(vein_of.size(), 0), part_(vein_of.size()) {
    std::vector<int> first;  // one wall node of each vein
    for (std::size_t i = 0; i < vein_of.size(); ++i) {
      if (vein_of[i] < 0) continue;
      const std::size_t vein = vein_of[i];
      if (first.size() <= vein) first.resize(vein + 1, -1);
      if (first[vein] < 0) first[vein] = static_cast<int>(i);
      part_.join(static_cast<int>(i), first[vein]);
    }
  }
  bool joined(const Edge& e) { return part_.find(e.a) == part_.find(e.b); }
  bool taken(const Edge& e) const { return taken_.contains({e.a, e.b}); }
  bool at_wall(const Edge& e) const { return vein_of_[e.a] >= 0 || vein_of_[e.b] >= 0; }
  /// True if both nodes may take another sinusoid: wall nodes one, others fewer than `limit`.
  bool has_free_degree(const Edge& e, int limit) const {
    const auto free = [&](int i) { return degree_[i] < (vein_of_[i] >= 0 ? 1 : limit); };
    return free(e.a) && free(e.b);
  }
  void take(const Edge& e) {
    out_.segment.push_back({e.a, e.b});
    taken_.insert({e.a, e.b});
    out_.length += e.length;
    ++degree_[e.a];
    ++degree_[e.b];
    part_.join(e.a, e.b);
  }

 private:
  const std::vector<int>& vein_of_;
  Sinusoids& out_;
  std::set<std::array<int, 2>> taken_;
  std::vector<int> degree_;
  DisjointSets part_;
};

}  // namespace

Sinusoids make_sinusoids(const LobuleParameters& p, const Domain& domain, const Uniform& uniform) {
  Sinusoids out;
  out.target_length =
      p.vessel_fraction * domain.volume / (kPi * p.sinusoid_radius * p.sinusoid_radius);
  if (p.vessel_fraction == 0) return out;
  add_branch_points(p, domain, uniform, out.node);
  out.n_branch = static_cast<int>(out.node.size());
  const std::vector<int> vein_of = add_wall_nodes(domain, out.node);
  std::vector<Edge> edge = delaunay_edges(out.node, vein_of, domain);
  Builder builder(vein_of, out);
  std::vector<Edge> rest;
  for (const Edge& e : edge)
    if (builder.at_wall(e) && builder.has_free_degree(e, kMaxDegree)) builder.take(e);
  for (const Edge& e : edge)
    if (!builder.joined(e) && builder.has_free_degree(e, kMaxDegree)) builder.take(e);
  for (const Edge& e : edge) {
    if (!builder.joined(e))  // a part that only a crowded node or a vein can join
      builder.take(e);
    else if (!e.through_vein && e.length < kLongestExtra && !builder.at_wall(e))
      rest.push_back(e);
  }
  for (const int limit : {3, kMaxDegree}) {
    std::vector<Edge> left;
    for (const Edge& e : rest) {
      if (out.length >= out.target_length) return out;
      if (builder.taken(e)) continue;
      if (builder.has_free_degree(e, limit))
        builder.take(e);
      else
        left.push_back(e);
    }
    rest = std::move(left);
  }
  return out;
}

}  // namespace acinus::coupling
