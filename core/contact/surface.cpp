#include "core/contact/surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/measures.hpp"

namespace acinus::contact {
namespace {

constexpr double kFacing = 0.2;  ///< normals with a larger dot product do not oppose each other
constexpr double kListFacing =
    0.7;  ///< the same for lists: leaves room for turning within the skin
constexpr double kSelfRings =
    3.0;  ///< self contact starts this many rest edges away on the surface
constexpr double kNoDirection = 1e-9;  ///< um, below which the closest point gives no normal

struct Site {
  Vec3 at, normal;
  double reach;
};
Site site_of(const SurfaceBody& b, Quadrature q, std::size_t s) {
  if (q == Quadrature::kThreePoint) return {b.center[s], b.triangle_normal[s], b.reach[s]};
  return {b.node[s], b.node_normal[s], 0};
}

const SurfaceBody& body_at(std::span<const SurfaceBody> bodies, std::span<const SurfaceBody> fixed,
                           int k) {
  const auto i = static_cast<std::size_t>(k);
  return i < bodies.size() ? bodies[i] : fixed[i - bodies.size()];
}

/// Where a triangle's centre lies on the unit rest shape.
Vec3 rest_center(const mesh::Topology& t, std::size_t triangle) {
  Vec3 sum = Vec3::Zero();
  for (int c : t.triangle[triangle]) sum += t.rest[static_cast<std::size_t>(c)];
  return sum / 3;
}

/// On the rest shape, far enough along the surface to count as another part of it.
bool far_on_surface(const SurfaceBody& b, Quadrature q, std::size_t site, std::size_t triangle) {
  const mesh::Topology& t = *b.topology;
  const Vec3 from = q == Quadrature::kThreePoint ? rest_center(t, site) : t.rest[site];
  return (from - rest_center(t, triangle)).norm() > kSelfRings * t.mean_rest_length;
}

/// Whether a body is so far from star-shaped that it might meet itself. While all normals are
/// within about 70 degrees of the direction from the centre, facing sides open at 40 degrees or
/// more and come close at the bottom of a cleft only, where they are neighbours along the surface.
bool may_fold(const SurfaceBody& b) {
  constexpr double kStar = 0.35;
  Vec3 center = Vec3::Zero();
  for (const Vec3& x : b.node) center += x;
  center /= static_cast<double>(b.node.size());
  for (std::size_t t = 0; t < b.center.size(); ++t) {
    const Vec3 out = b.center[t] - center;
    if (b.triangle_normal[t].dot(out) < kStar * out.norm()) return true;
  }
  return false;
}

void fill(Candidates& list, const SurfaceBody& a, const SurfaceBody& b, const SearchOptions& o) {
  const bool self = list.body_a == list.body_b;
  const double margin = (self ? o.self_range : std::max(o.range, o.max_depth)) + o.skin;
  const Box near = self ? a.box : b.box.grown(margin);
  std::vector<int> others;
  const Box mine = a.box.grown(margin);
  for (std::size_t t = 0; t < b.center.size(); ++t)
    if (self || mine.grown(b.reach[t]).contains(b.center[t])) others.push_back(static_cast<int>(t));

  std::vector<std::pair<double, int>> found;
  list.start.assign(1, 0);
  for (std::size_t s = 0; s < n_sites(a, o.quadrature); ++s) {
    const Site site = site_of(a, o.quadrature, s);
    if (!near.grown(site.reach).contains(site.at)) continue;
    found.clear();
    for (int t : others) {
      const auto k = static_cast<std::size_t>(t);
      const double far = site.reach + b.reach[k] + margin;
      const double d2 = (site.at - b.center[k]).squaredNorm();
      if (d2 > far * far || site.normal.dot(b.triangle_normal[k]) > kListFacing) continue;
      if (self && !far_on_surface(a, o.quadrature, s, k)) continue;
      found.emplace_back(d2, t);
    }
    if (found.empty()) continue;
    std::ranges::sort(found);
    list.site.push_back(static_cast<int>(s));
    for (const auto& f : found) list.triangle.push_back(f.second);
    list.start.push_back(static_cast<std::uint32_t>(list.triangle.size()));
  }
}

}  // namespace

void refresh_body(SurfaceBody& b) {
  const auto& triangle = *b.triangle;
  b.node_normal.assign(b.node.size(), Vec3::Zero());
  b.triangle_normal.resize(triangle.size());
  b.center.resize(triangle.size());
  b.reach.resize(triangle.size());
  b.box = Box{};
  for (const Vec3& x : b.node) b.box.include(x);
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const Vec3& x0 = b.node[static_cast<std::size_t>(triangle[t][0])];
    const Vec3& x1 = b.node[static_cast<std::size_t>(triangle[t][1])];
    const Vec3& x2 = b.node[static_cast<std::size_t>(triangle[t][2])];
    const Vec3 n = (x1 - x0).cross(x2 - x0);
    b.center[t] = (x0 + x1 + x2) / 3;
    b.reach[t] =
        std::sqrt(std::max({(x0 - b.center[t]).squaredNorm(), (x1 - b.center[t]).squaredNorm(),
                            (x2 - b.center[t]).squaredNorm()}));
    const double norm = n.norm();
    b.triangle_normal[t] = norm > 0 ? Vec3(n / norm) : Vec3::Zero();
    for (int c : triangle[t]) b.node_normal[static_cast<std::size_t>(c)] += n;
  }
  for (Vec3& n : b.node_normal) {
    const double norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

PointStencil point_stencil(const SurfaceBody& body, Quadrature q, int point) {
  if (q == Quadrature::kNodes) return {1, {point, 0, 0}, {1, 0, 0}};
  const auto& corner = (*body.triangle)[static_cast<std::size_t>(point / 3)];
  constexpr double kSmall = 1.0f / 6, kLarge = 2.0f / 3;
  const int local = point % 3;
  const double w0 = local == 0 ? kLarge : kSmall, w1 = local == 1 ? kLarge : kSmall;
  return {3, corner, {w0, w1, 1 - w0 - w1}};
}

std::vector<Candidates> find_candidates(std::span<const SurfaceBody> bodies,
                                        std::span<const SurfaceBody> fixed,
                                        const SearchOptions& o) {
  const double margin = std::max(o.range, o.max_depth) + o.skin;
  std::vector<Box> boxes, fixed_boxes;
  for (const SurfaceBody& b : bodies) boxes.push_back(b.box);
  for (const SurfaceBody& b : fixed) fixed_boxes.push_back(b.box);
  std::vector<Candidates> lists;
  for (auto [a, b] : find_pairs(boxes, margin)) {
    lists.push_back({a, b, {}, {}, {}});
    lists.push_back({b, a, {}, {}, {}});
  }
  for (auto [a, b] : find_pairs_between(boxes, fixed_boxes, margin))
    lists.push_back({a, b + static_cast<int>(bodies.size()), {}, {}, {}});
  if (o.self_range > 0)
    for (int a = 0; a < static_cast<int>(bodies.size()); ++a)
      if (bodies[static_cast<std::size_t>(a)].topology &&
          may_fold(bodies[static_cast<std::size_t>(a)]))
        lists.push_back({a, a, {}, {}, {}});
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t k = 0; k < lists.size(); ++k)
    fill(lists[k], body_at(bodies, fixed, lists[k].body_a), body_at(bodies, fixed, lists[k].body_b),
         o);
  std::erase_if(lists, [](const Candidates& c) { return c.site.empty(); });
  std::ranges::sort(lists, {}, [](const Candidates& c) { return std::pair(c.body_a, c.body_b); });
  return lists;
}

void find_contacts(const Candidates& list, std::span<const SurfaceBody> bodies,
                   std::span<const SurfaceBody> fixed, const SearchOptions& o,
                   std::vector<SurfaceContact>& out) {
  const bool self = list.body_a == list.body_b;
  const SurfaceBody& a = body_at(bodies, fixed, list.body_a);
  const SurfaceBody& b = body_at(bodies, fixed, list.body_b);
  const double horizon = self ? o.self_range : std::max(o.range, o.max_depth);
  const int per_site = points_per_site(o.quadrature);
  for (std::size_t s = 0; s < list.site.size(); ++s) {
    const std::uint32_t from = list.start[s], to = list.start[s + 1];
    for (int q = 0; q < per_site; ++q) {
      const int point = list.site[s] * per_site + q;
      const Vec3 x = point_position(a, point_stencil(a, o.quadrature, point));
      double best2 = horizon * horizon, best = horizon;
      int triangle = -1;
      mesh::ClosestPoint closest;
      for (std::uint32_t k = from; k < to; ++k) {
        const auto t = static_cast<std::size_t>(list.triangle[k]);
        const double far = best + b.reach[t] + kNoDirection;
        if ((x - b.center[t]).squaredNorm() > far * far) continue;
        const auto& corner = (*b.triangle)[t];
        const mesh::ClosestPoint c =
            mesh::find_closest_point(x, b.node[static_cast<std::size_t>(corner[0])],
                                     b.node[static_cast<std::size_t>(corner[1])],
                                     b.node[static_cast<std::size_t>(corner[2])]);
        // Ties (an edge two triangles share) go to the lower number: the order of the list, which
        // depends on when it was made, must not show.
        const bool tie = c.squared_distance == best2 && static_cast<int>(t) < triangle;
        if (c.squared_distance < best2 || tie) {
          best2 = c.squared_distance;
          best = std::sqrt(best2);
          closest = c;
          triangle = static_cast<int>(t);
        }
      }
      if (triangle < 0) continue;
      const auto& corner = (*b.triangle)[static_cast<std::size_t>(triangle)];
      Vec3 outward = Vec3::Zero();
      SurfaceContact contact{list.body_a, point, list.body_b, triangle, {}, {}, 0};
      contact.weight_b = {static_cast<float>(closest.weight[0]),
                          static_cast<float>(closest.weight[1])};
      const auto weight = contact.weights();
      Vec3 place = Vec3::Zero();
      for (std::size_t m = 0; m < 3; ++m) {
        const auto node = static_cast<std::size_t>(corner[m]);
        outward += weight[m] * b.node_normal[node];
        place += weight[m] * b.node[node];
      }
      const double length = outward.norm();
      if (length > 0) outward /= length;
      const Vec3& facing = o.quadrature == Quadrature::kThreePoint
                               ? a.triangle_normal[static_cast<std::size_t>(list.site[s])]
                               : a.node_normal[static_cast<std::size_t>(list.site[s])];
      if (facing.dot(outward) > kFacing) continue;
      const Vec3 apart = x - place;
      const double distance = apart.norm();
      const double sign = apart.dot(outward) >= 0 ? 1.0 : -1.0;
      const double gap = sign * distance;
      // A sheet met through the cell's own inside is not a contact.
      if (self && sign < 0) continue;
      if (gap > (self ? o.self_range : o.range) || gap < -o.max_depth) continue;
      contact.normal = distance > kNoDirection ? Vec3(sign / distance * apart) : outward;
      contact.gap = gap;
      out.push_back(contact);
    }
  }
}

}  // namespace acinus::contact
