#include "core/contact/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/lanes.hpp"
#include "core/mesh/closest_point.hpp"
#include "core/rounding.hpp"

namespace acinus::contact {
namespace {

constexpr double kFacing = 0.2;  ///< normals with a larger dot product do not oppose each other
/// The same for lists: leaves room for turning within the skin.
constexpr double kListFacing = 0.7;
/// Self contact starts this many rest edges away on the surface.
constexpr double kSelfRings = 3.0;
/// um, below which the closest point gives no normal: its weights are rounded to 1e-7 of an edge.
constexpr double kNoDirection = 1e-6;
constexpr double kRounding = 1e-4;  ///< um, more than floats lose on a list's distances

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

/// Squared distance to the disc about a triangle's centre that holds it: never more than to the
/// triangle itself.
ACINUS_INLINE double squared_bound(const SurfaceBody& b, std::size_t t, const Vec3& x) {
  const Vec3 d = x - b.center[t];
  const double height = d.dot(b.triangle_normal[t]), squared_height = height * height;
  const double across = std::sqrt(std::max(0.0, d.squaredNorm() - squared_height)) - b.reach[t];
  return squared_height + (across > 0 ? across * across : 0);
}

/// The closest place on a surface so far.
struct Closest {
  double squared = 0;
  int triangle = -1;
  mesh::ClosestPoint at;

  ACINUS_INLINE void look_at(const SurfaceBody& b, int t, const Vec3& x) {
    const auto& corner = (*b.triangle)[static_cast<std::size_t>(t)];
    const mesh::ClosestPoint c = mesh::find_closest_point(
        x, b.node[static_cast<std::size_t>(corner[0])], b.node[static_cast<std::size_t>(corner[1])],
        b.node[static_cast<std::size_t>(corner[2])]);
    // Ties (an edge two triangles share) go to the lower number: the order of the list, which
    // depends on when it was made, must not show.
    if (c.squared_distance < squared || (c.squared_distance == squared && t < triangle)) {
      squared = c.squared_distance;
      at = c;
      triangle = t;
    }
  }
};

/// Blend of the node normals at a place on a triangle.
Vec3 blended_normal(const SurfaceBody& b, int triangle, const Vec3& weight) {
  const auto& corner = (*b.triangle)[static_cast<std::size_t>(triangle)];
  Vec3 n = Vec3::Zero();
  for (int m = 0; m < 3; ++m)
    n += weight[m] * b.node_normal[static_cast<std::size_t>(corner[static_cast<std::size_t>(m)])];
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : n;
}

/// Triangles as discs, one array per number, about an origin near them: floats then keep distances
/// to less than kRounding.
struct Discs {
  Vec3 origin = Vec3::Zero();
  std::vector<int> triangle;
  std::vector<float> x, y, z, nx, ny, nz, reach;

  void add(const SurfaceBody& b, int t) {
    const auto k = static_cast<std::size_t>(t);
    const Vec3 c = b.center[k] - origin;
    const Vec3& n = b.triangle_normal[k];
    triangle.push_back(t);
    for (auto [to, value] : {std::pair(&x, c[0]),
                             {&y, c[1]},
                             {&z, c[2]},
                             {&nx, n[0]},
                             {&ny, n[1]},
                             {&nz, n[2]},
                             {&reach, b.reach[k]}})
      to->push_back(static_cast<float>(value));
  }
};

/// squared_bound of many triangles at once.
ACINUS_KERNEL void compute_bounds(const std::array<float, 3>& at, std::size_t n, const float* x,
                                  const float* y, const float* z, const float* nx, const float* ny,
                                  const float* nz, const float* reach, float* bound) {
  for (std::size_t k = 0; k < n; ++k) {
    const float dx = at[0] - x[k], dy = at[1] - y[k], dz = at[2] - z[k];
    const float height = dx * nx[k] + dy * ny[k] + dz * nz[k], squared = height * height;
    const float in_plane = dx * dx + dy * dy + dz * dz - squared;
    const float across = __builtin_sqrtf(in_plane > 0 ? in_plane : 0) - reach[k];
    bound[k] = squared + (across > 0 ? across * across : 0);
  }
}

/// Makes one list.
class ListBuilder {
 public:
  ListBuilder(const SurfaceBody& a, const SurfaceBody& b, const SearchOptions& o, bool self)
      : a_(a),
        b_(b),
        o_(o),
        self_(self),
        out_(self ? o.self_range : o.range),
        depth_(self ? 0 : o.max_depth),
        margin_(std::max(out_, depth_) + o.skin) {
    find_near_triangles();
  }

  void fill(Candidates& list) {
    const bool face = o_.quadrature == Quadrature::kThreePoint;
    list.start.assign(1, 0);
    for (std::size_t s = 0; s < n_sites(a_, o_.quadrature); ++s) {
      const Vec3& at = face ? a_.center[s] : a_.node[s];
      const double reach = face ? a_.reach[s] : 0;
      if (at.dot(axis_) + reach < low_b_ || !near_b_.grown(reach).contains(at)) continue;
      const Vec3& normal = face ? a_.triangle_normal[s] : a_.node_normal[s];
      const double radius = face ? 0.5 * reach : 0;  // its points are no farther from its place
      compute_bounds_from(at);
      near_site_.clear();
      const auto far = static_cast<float>(std::pow(margin_ + radius + kRounding, 2));
      for (std::size_t i = 0; i < bound_.size(); ++i) {
        if (bound_[i] > far) continue;
        const auto k = static_cast<std::size_t>(discs_.triangle[i]);
        if (normal.dot(b_.triangle_normal[k]) > kListFacing) continue;
        if (self_ && !far_on_surface(a_, o_.quadrature, s, k)) continue;
        near_site_.push_back(i);
      }
      if (near_site_.empty()) continue;
      if (!face) {
        if (may_matter(find_gap(at), 0)) add(static_cast<int>(s), list);
        continue;
      }
      if (!narrow_down(at, radius)) continue;
      for (int q = 0; q < 3; ++q) add(3 * static_cast<int>(s) + q, list);
    }
  }

 private:
  /// Triangles of b that anything of a may come near: those within a's box and on its side.
  void find_near_triangles() {
    near_b_ = b_.box.grown(margin_);
    double high_a = 1e300;
    if (!self_) {
      const Vec3 apart = b_.box.low + b_.box.high - a_.box.low - a_.box.high;
      if (apart.norm() > 0) {
        axis_ = apart.normalized();
        double high = -1e300, low = 1e300;
        for (const Vec3& x : a_.node) high = std::max(high, x.dot(axis_));
        for (const Vec3& x : b_.node) low = std::min(low, x.dot(axis_));
        high_a = high + margin_;
        low_b_ = low - margin_;
      }
    }
    const Box near_a = a_.box.grown(margin_);
    discs_.origin = 0.5 * (b_.box.low + b_.box.high);
    for (std::size_t t = 0; t < b_.center.size(); ++t)
      if (self_ || (b_.center[t].dot(axis_) - b_.reach[t] < high_a &&
                    near_a.grown(b_.reach[t]).contains(b_.center[t])))
        discs_.add(b_, static_cast<int>(t));
    bound_.resize(discs_.triangle.size());
  }

  void compute_bounds_from(const Vec3& at) {
    const Vec3 d = at - discs_.origin;
    compute_bounds({static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])},
                   bound_.size(), discs_.x.data(), discs_.y.data(), discs_.z.data(),
                   discs_.nx.data(), discs_.ny.data(), discs_.nz.data(), discs_.reach.data(),
                   bound_.data());
  }

  /// Signed distance of x from the triangles near its site. @pre compute_bounds_from(x)
  double find_gap(const Vec3& x) const {
    std::size_t least = near_site_[0];
    for (std::size_t i : near_site_)
      if (bound_[i] < bound_[least]) least = i;
    Closest closest{1e300, -1, {}};
    closest.look_at(b_, discs_.triangle[least], x);
    for (std::size_t i : near_site_)
      if (i != least && static_cast<double>(bound_[i]) <= closest.squared + kRounding)
        closest.look_at(b_, discs_.triangle[i], x);
    const Vec3 outward = blended_normal(b_, closest.triangle, closest.at.weight);
    const double distance = std::sqrt(closest.squared);
    return (x - closest.at.point).dot(outward) >= 0 ? distance : -distance;
  }

  /// Whether a gap here may become a contact before the list expires.
  bool may_matter(double gap, double radius) const {
    return gap <= out_ + o_.skin + radius && -gap <= depth_ + o_.skin + radius;
  }

  /// Leaves the triangles that matter for points within `radius` of x; false if none does.
  bool narrow_down(const Vec3& x, double radius) {
    const double gap = find_gap(x);
    if (!may_matter(gap, radius)) return false;
    const auto far =
        static_cast<float>(std::pow(std::abs(gap) + 2 * (radius + o_.skin) + kRounding, 2));
    std::erase_if(near_site_, [&](std::size_t i) { return bound_[i] > far; });
    return true;
  }

  /// Adds a point with every triangle that may be closest to it before the list expires.
  void add(int point, Candidates& list) {
    const Vec3 x = point_position(a_, point_stencil(a_, o_.quadrature, point));
    compute_bounds_from(x);
    const double gap = find_gap(x);
    if (!may_matter(gap, 0)) return;
    list.point.push_back(point);
    list.gap.push_back(static_cast<float>(gap));
    const auto far = static_cast<float>(std::pow(std::abs(gap) + 2 * o_.skin + kRounding, 2));
    sorted_.clear();
    for (std::size_t i : near_site_)
      if (bound_[i] <= far) sorted_.emplace_back(bound_[i], discs_.triangle[i]);
    std::ranges::sort(sorted_);
    for (const auto& [bound, t] : sorted_) {
      list.triangle.push_back(t);
      list.bound.push_back(std::sqrt(bound));
    }
    list.start.push_back(static_cast<std::uint32_t>(list.triangle.size()));
  }

  const SurfaceBody &a_, &b_;
  const SearchOptions& o_;
  bool self_;
  double out_, depth_, margin_;
  Vec3 axis_ = Vec3::Zero();  ///< from a to b
  double low_b_ = -1e300;     ///< of axis . x
  Box near_b_;
  Discs discs_;                         ///< triangles of b that anything of a may come near
  std::vector<float> bound_;            ///< um^2, of discs_, from the place looked at last
  std::vector<std::size_t> near_site_;  ///< of discs_
  std::vector<std::pair<float, int>> sorted_;
};

}  // namespace

std::vector<std::pair<int, int>> find_near_bodies(std::span<const SurfaceBody> bodies,
                                                  const SearchOptions& o, double reserve) {
  std::vector<Box> boxes;
  for (const SurfaceBody& b : bodies) boxes.push_back(b.box);
  return find_pairs(boxes, std::max(o.range, o.max_depth) + o.skin + reserve);
}

std::vector<Candidates> find_candidates(std::span<const SurfaceBody> bodies,
                                        std::span<const SurfaceBody> fixed,
                                        std::span<const std::pair<int, int>> near,
                                        const SearchOptions& o) {
  const double margin = std::max(o.range, o.max_depth) + o.skin;
  std::vector<Candidates> lists;
  auto add_list = [&](int a, int b) {
    lists.emplace_back();
    lists.back().body_a = a;
    lists.back().body_b = b;
  };
  for (auto [a, b] : near) {
    if (!bodies[static_cast<std::size_t>(a)].box.grown(margin).overlaps(
            bodies[static_cast<std::size_t>(b)].box))
      continue;
    add_list(a, b);
    add_list(b, a);
  }
  if (!fixed.empty()) {
    std::vector<Box> boxes, fixed_boxes;
    for (const SurfaceBody& b : bodies) boxes.push_back(b.box);
    for (const SurfaceBody& b : fixed) fixed_boxes.push_back(b.box);
    for (auto [a, b] : find_pairs_between(boxes, fixed_boxes, margin))
      add_list(a, b + static_cast<int>(bodies.size()));
  }
  if (o.self_range > 0)
    for (int a = 0; a < static_cast<int>(bodies.size()); ++a)
      if (bodies[static_cast<std::size_t>(a)].topology &&
          may_fold(bodies[static_cast<std::size_t>(a)]))
        add_list(a, a);
#pragma omp parallel
  {
    Candidates scratch;  // grows as needed; what is kept is copied to measure
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < lists.size(); ++k) {
      scratch.clear();
      scratch.body_a = lists[k].body_a;
      scratch.body_b = lists[k].body_b;
      ListBuilder(body_at(bodies, fixed, lists[k].body_a), body_at(bodies, fixed, lists[k].body_b),
                  o, lists[k].body_a == lists[k].body_b)
          .fill(scratch);
      lists[k] = scratch;
    }
  }
  std::erase_if(lists, [](const Candidates& c) { return c.point.empty(); });
  std::ranges::sort(lists, {}, [](const Candidates& c) { return std::pair(c.body_a, c.body_b); });
  return lists;
}

std::size_t find_contacts(const Candidates& list, std::span<const SurfaceBody> bodies,
                          std::span<const SurfaceBody> fixed, const SearchOptions& o, double moved,
                          std::vector<SurfaceContact>& out) {
  const bool self = list.body_a == list.body_b;
  const bool is_fixed = static_cast<std::size_t>(list.body_b) >= bodies.size();
  const SurfaceBody& a = body_at(bodies, fixed, list.body_a);
  const SurfaceBody& b = body_at(bodies, fixed, list.body_b);
  const double range = self ? o.self_range : o.range, depth = self ? 0 : o.max_depth;
  const double horizon = std::max(range, depth), shift = moved + kRounding;
  const int per_site = points_per_site(o.quadrature);
  std::size_t looked = 0;
  for (std::size_t p = 0; p < list.point.size(); ++p) {
    const double before = static_cast<double>(list.gap[p]);
    if (before - shift > range || -before - shift > depth) continue;
    ++looked;
    const Vec3 x = point_position(a, point_stencil(a, o.quadrature, list.point[p]));
    Closest closest{horizon * horizon, -1, {}};
    double best = horizon;
    for (std::uint32_t k = list.start[p]; k < list.start[p + 1]; ++k) {
      if (static_cast<double>(list.bound[k]) - shift > best) break;
      const auto t = static_cast<std::size_t>(list.triangle[k]);
      if (k > list.start[p] && squared_bound(b, t, x) > closest.squared) continue;
      const double squared = closest.squared;
      closest.look_at(b, list.triangle[k], x);
      if (closest.squared < squared) best = std::sqrt(closest.squared);
    }
    if (closest.triangle < 0) continue;
    SurfaceContact contact{list.body_a, list.point[p], list.body_b, closest.triangle, {}, {}, 0};
    contact.weight_b = {round_to_float(closest.at.weight[0]), round_to_float(closest.at.weight[1])};
    const auto w = contact.weights();
    const Vec3 weight(w[0], w[1], w[2]);
    const Vec3 outward = blended_normal(b, closest.triangle, weight);
    const auto site = static_cast<std::size_t>(list.point[p] / per_site);
    const Vec3& facing =
        o.quadrature == Quadrature::kThreePoint ? a.triangle_normal[site] : a.node_normal[site];
    if (facing.dot(outward) > kFacing) continue;
    const auto& corner = (*b.triangle)[static_cast<std::size_t>(closest.triangle)];
    Vec3 apart = x;
    if (is_fixed) {  // no unknowns there: the exact place, which may be far from its corners
      apart -= closest.at.point;
    } else {
      for (std::size_t m = 0; m < 3; ++m)
        apart -= w[m] * b.node[static_cast<std::size_t>(corner[m])];
    }
    const double distance = apart.norm();
    const double sign = apart.dot(outward) >= 0 ? 1.0 : -1.0;
    const double gap = sign * distance;
    // A sheet met through the cell's own inside is not a contact.
    if (self && sign < 0) continue;
    if (gap > range || gap < -depth) continue;
    contact.normal = distance > kNoDirection ? Vec3(sign / distance * apart) : outward;
    contact.gap = gap;
    out.push_back(contact);
  }
  return looked;
}

}  // namespace acinus::contact
