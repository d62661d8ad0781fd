#include "contact/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "contact/closest.hpp"
#include "contact/discs.hpp"
#include "contact/reach.hpp"
#include "contact/self_contact.hpp"
#include "core/numbers/lanes.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/closest_point.hpp"

namespace acinus::contact {
namespace {

/// Distance bounds of discs, um, up to the end of the last eight: never above the distances of the
/// triangles.
/// @param from  position relative to the origin of the discs, um
ACINUS_KERNEL void compute_bounds(const float* number, std::size_t n,
                                  const std::array<float, 3>& from, float* bound) {
  using Floats = LaneOf<float>;
  const Floats zero{};
  const auto root = [](Floats v) __attribute__((always_inline))->Floats {
    for (int l = 0; l < kLanes; ++l) v[l] = __builtin_sqrtf(v[l]);
    return v;
  };
  for (std::size_t k = 0; k < n; k += kLanes, number += Discs::kStride) {
    const auto center = load3<float>(number), normal = load3<float>(number + 3 * kLanes);
    const Lane3Of<float> d{from[0] - center.x, from[1] - center.y, from[2] - center.z};
    const Floats height = dot(d, normal), squared = height * height;
    const Floats in_plane = dot(d, d) - squared;
    const Floats beyond =
        root(in_plane > 0.0f ? in_plane : zero) - load<float>(number + 6 * kLanes);
    const Floats across = beyond > 0.0f ? beyond : zero;
    store(bound + k, root(squared + across * across));
  }
}

/// Largest distance of the entries of a list, um.
double compute_margin(const SearchOptions& o) { return std::max(o.range, o.max_depth) + o.skin; }

/// Builder of candidate lists, reused from list to list.
class ListBuilder {
 public:
  void start(const SearchOptions& o) { o_ = o; }

  void fill(const SurfaceBody& a, const SurfaceBody& b, bool self, WideCandidates& list) {
    a_ = &a;
    b_ = &b;
    self_ = self;
    out_ = self ? o_.self_range : o_.range;
    depth_ = self ? 0 : o_.max_depth;
    margin_ = std::max(out_, depth_) + o_.skin;
    list_ = &list;
    list.start.assign(1, 0);
    compute_reach();
    origin_ = 0.5 * (b.box.low + b.box.high);
    if (o_.triangles)
      select_circumspheres(near_a_, b);
    else
      select_triangles(near_a_, b);
    discs_.reset(included_.size());
    for (const int t : included_) discs_.add(b, t, origin_);
    near_.reset(discs_.n);
    bound_.resize(std::max(bound_.size(), discs_.triangle.size()));
    near_index_.resize(discs_.triangle.size());
    clear_block();
    if (discs_.n == 0) return;
    if (o_.triangles && !self) return add_triangles();
    select_near_sites();
    for (const int s : included_) add_site(s);
    flush();
  }

 private:
  void compute_reach() {
    auto make = [this](const Box& box) {
      return Reach{0.5 * (box.low + box.high), (0.5 * (box.high - box.low)).array() + margin_};
    };
    near_a_ = make(a_->box);
    near_b_ = make(b_->box);
    if (self_) return;
    const Vec3 apart = near_b_.middle - near_a_.middle;
    if (!(apart.norm() > 0)) return;
    const Vec3 axis = apart.normalized();
    double high = -1e300, low = 1e300;
    for (const Vec3& x : a_->node) high = std::max(high, x.dot(axis));
    for (const Vec3& x : b_->node) low = std::min(low, x.dot(axis));
    near_a_.axis = axis;
    near_a_.limit = high + margin_;
    near_b_.axis = -axis;
    near_b_.limit = margin_ - low;
  }

  /// Selects the places (with their radii, if any) within a region. Branch-free: no misprediction.
  void select_near(const Reach& reach, std::span<const Vec3> place,
                   std::span<const double> radius) {
    included_.resize(place.size());
    std::size_t n = 0;
    for (std::size_t k = 0; k < place.size(); ++k) {
      included_[n] = static_cast<int>(k);
      n += reach.includes(place[k], radius.empty() ? 0 : radius[k]) ? 1 : 0;
    }
    included_.resize(n);
  }

  /// Selects the triangles that have a point within a region: no bound of it has all three corners
  /// outside.
  void select_triangles(const Reach& reach, const SurfaceBody& body) {
    const std::vector<std::array<int, 3>>& triangle = *body.triangle;
    outside_.resize(body.node.size());
    for (std::size_t i = 0; i < outside_.size(); ++i) outside_[i] = reach.outside(body.node[i]);
    included_.resize(triangle.size());
    std::size_t n = 0;
    for (std::size_t t = 0; t < triangle.size(); ++t) {
      const auto& [i, j, k] = triangle[t];
      included_[n] = static_cast<int>(t);
      n += (outside_[i] & outside_[j] & outside_[k]) == 0 ? 1 : 0;
    }
    included_.resize(n);
  }

  /// Selects the triangles whose circumspheres reach into a region.
  void select_circumspheres(const Reach& reach, const SurfaceBody& body) {
    if (!body.center.empty()) return select_near(reach, body.center, body.reach);
    const std::size_t n = body.triangle->size();
    place_.resize(n);
    radius_.resize(n);
    for (std::size_t t = 0; t < n; ++t) {
      place_[t] = triangle_center(body, t);
      radius_[t] = triangle_reach(body, t);
    }
    select_near(reach, place_, radius_);
  }

  /// Selects the sites of a near b.
  void select_near_sites() {
    switch (o_.quadrature) {
      case Quadrature::kThreePoint:
        return select_triangles(near_b_, *a_);
      case Quadrature::kNodes:
        return select_near(near_b_, a_->node, {});
      case Quadrature::kNodesAndEdges:
        break;
    }
    place_.resize(n_sites(*a_, o_.quadrature));
    for (std::size_t s = 0; s < place_.size(); ++s) place_[s] = site_place(*a_, o_.quadrature, s);
    select_near(near_b_, place_, {});
  }

  /// Lists the triangles of b within the margin of each triangle of a.
  void add_triangles() {
    select_circumspheres(near_b_, *a_);
    for (const int s : included_) {
      compute_bounds_from(discs_, triangle_center(*a_, s));
      const auto far = static_cast<float>(margin_ + triangle_reach(*a_, s) + kRounding);
      const std::size_t before = list_->triangle.size();
      for (std::size_t k = 0; k < discs_.n; ++k)
        if (bound_[k] <= far) list_->triangle.push_back(discs_.triangle[k]);
      if (list_->triangle.size() == before) continue;
      list_->point.push_back(s);
      list_->start.push_back(static_cast<std::uint32_t>(list_->triangle.size()));
    }
  }

  void compute_bounds_from(const Discs& discs, const Vec3& x) {
    const Vec3 d = x - origin_;
    compute_bounds(discs.number.data(), discs.n,
                   {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])},
                   bound_.data());
  }

  /// Adds the points of one site to the block if they are near.
  void add_site(std::size_t site) {
    const Vec3 at = site_place(*a_, o_.quadrature, site);
    // Bound of the distance of a site's points from its position, um.
    const double radius = 0.5 * site_reach(*a_, o_.quadrature, site);
    compute_bounds_from(discs_, at);
    const auto far = static_cast<float>(margin_ + radius + kRounding);
    const int n_disc = static_cast<int>(discs_.n);
    int* const near = near_index_.data();
    const float* const bound = bound_.data();
    int n = 0;
    for (int i = 0; i < n_disc; ++i) {  // branch-free
      near[n] = i;
      n += bound[i] <= far ? 1 : 0;
    }
    if (self_)
      n = static_cast<int>(std::remove_if(near, near + n,
                                          [&](int i) {
                                            return !far_on_surface(*a_, o_.quadrature, site,
                                                                   discs_.triangle_at(i));
                                          }) -
                           near);
    if (n == 0) return;

    int likely = near[0];
    for (int k = 1; k < n; ++k) likely = bound[near[k]] < bound[likely] ? near[k] : likely;
    const auto& corner = (*b_->triangle)[discs_.triangle_at(likely)];
    const double no_more =
        std::sqrt(geometry::find_closest_point(at, b_->node[corner[0]], b_->node[corner[1]],
                                               b_->node[corner[2]])
                      .squared_distance);
    const auto matters = static_cast<float>(no_more + 2 * (radius + o_.skin) + kRounding);
    near_.reset(0);
    for (int k = 0; k < n; ++k)
      if (bound[near[k]] <= matters) near_.add(discs_, near[k]);
    const int per_site = points_per_site(o_.quadrature);
    for (int q = 0; q < per_site; ++q) add(static_cast<int>(site) * per_site + q, no_more + radius);
  }

  /// Adds a point to the block with the triangles near its site that may be closest to it before
  /// the list expires.
  /// @param no_more  um, bound of the distance of the closest one
  void add(int point, double no_more) {
    const Vec3 x = point_position(*a_, point_stencil(*a_, o_.quadrature, point));
    compute_bounds_from(near_, x);
    const auto matters = static_cast<float>(no_more + 2 * o_.skin + kRounding);
    const std::size_t first = n_wide_, most = n_wide_ + near_.n + 1;
    if (wide_triangle_.size() < most) {
      wide_triangle_.resize(2 * most);
      wide_bound_.resize(2 * most);
    }
    int* const triangle = wide_triangle_.data();
    float* const bound = wide_bound_.data();
    std::size_t end = first, likely = first;
    float least = matters;
    for (std::size_t i = 0; i < near_.n; ++i) {  // branch-free
      const float here = bound_[i];
      triangle[end] = near_.triangle[i];
      bound[end] = here;
      likely = here < least ? end : likely;
      least = here < least ? here : least;
      end += here <= matters ? 1 : 0;
    }
    if (end == first || static_cast<double>(least) > margin_ + kRounding) return;
    n_wide_ = end;
    std::swap(triangle[first], triangle[likely]);
    std::swap(bound[first], bound[likely]);
    const std::size_t n = block_.n++;
    point_[n] = point;
    for (std::size_t m = 0; m < 3; ++m) block_.x[3 * n + m] = x[static_cast<int>(m)];
    block_.begin[n] = static_cast<std::uint32_t>(first);
    block_.end[n] = static_cast<std::uint32_t>(n_wide_);
    if (block_.n == PointBlock::kSize) flush();
  }

  /// Lists the points of the block whose gap may become a contact before the list expires.
  void flush() {
    constexpr double kAnywhere = 1e150;
    const double turn =
        2 * o_.skin + kRounding;  // motion that may change which of two triangles is closer
    wide_distance_.assign(n_wide_, std::numeric_limits<float>::infinity());
    find_closest(*b_, {wide_triangle_, wide_bound_}, turn, kAnywhere, block_, wide_distance_);
    compute_gaps(*b_, Place::kExact, block_);
    std::size_t end = list_->triangle.size();
    list_->triangle.resize(end + n_wide_ + 1);
    list_->bound.resize(end + n_wide_ + 1);
    int* const triangle = list_->triangle.data();
    float* const bound = list_->bound.data();
    for (int n = 0; n < block_.n; ++n) {
      const double gap = block_.gap[n];
      if (gap > out_ + o_.skin || -gap > depth_ + o_.skin || block_.triangle[n] < 0) continue;
      list_->point.push_back(point_[n]);
      list_->gap.push_back(static_cast<float>(gap));
      const auto matters = static_cast<float>(std::abs(gap) + turn);
      const std::size_t first = end;
      std::size_t closest = first;
      for (std::uint32_t k = block_.begin[n]; k < block_.end[n]; ++k) {  // branch-free
        triangle[end] = wide_triangle_[k];
        bound[end] = wide_distance_[k];
        closest = triangle[end] == block_.triangle[n] ? end : closest;
        end += bound[end] <= matters ? 1 : 0;
      }
      std::swap(triangle[first], triangle[closest]);
      std::swap(bound[first], bound[closest]);
      list_->start.push_back(static_cast<std::uint32_t>(end));
    }
    list_->triangle.resize(end);
    list_->bound.resize(end);
    clear_block();
  }

  void clear_block() {
    block_.n = 0;
    n_wide_ = 0;
  }

  SearchOptions o_;
  // of the list being made:
  const SurfaceBody *a_ = nullptr, *b_ = nullptr;
  WideCandidates* list_ = nullptr;
  bool self_ = false;
  double out_ = 0, depth_ = 0, margin_ = 0;
  Reach near_a_, near_b_;
  std::vector<Vec3> place_;        ///< of sites or triangles
  std::vector<double> radius_;     ///< of triangles
  std::vector<unsigned> outside_;  ///< of nodes
  std::vector<int> included_;
  Vec3 origin_ = Vec3::Zero();  ///< of the discs
  Discs discs_;                 ///< triangles of b near any part of a
  // of the current site:
  std::vector<int> near_index_;  ///< of discs_
  Discs near_;                   ///< those that may be closest to one of its points
  std::vector<float> bound_;     ///< um, of the discs of the last call
  // of the points collected:
  PointBlock block_;
  std::array<int, PointBlock::kSize> point_{};
  std::size_t n_wide_ = 0;
  std::vector<int> wide_triangle_;  ///< candidates of the points
  std::vector<float> wide_bound_;   ///< um
  std::vector<float> wide_distance_;
};

}  // namespace

std::vector<Candidates> list_pairs(std::span<const SurfaceBody> bodies,
                                   std::span<const SurfaceBody> fixed, const SearchOptions& o,
                                   double reserve) {
  const double margin = compute_margin(o) + reserve;
  std::vector<Box> boxes, fixed_boxes;
  for (const SurfaceBody& b : bodies) boxes.push_back(b.box);
  for (const SurfaceBody& b : fixed) fixed_boxes.push_back(b.box);
  const auto n = static_cast<int>(bodies.size());
  const std::vector<std::pair<int, int>> both = geometry::find_pairs(boxes, margin);
  const std::vector<std::pair<int, int>> probed =
      geometry::find_pairs_between(boxes, fixed_boxes, margin);
  // f(a, b) for all pairs, those of each a ascending: pairs come in order of their first bodies.
  const auto for_each_pair = [&](const auto& f) {
    if (!o.triangles)
      for (const auto& [a, b] : both) f(b, a);
    if (o.self_range > 0)
      for (int a = 0; a < n; ++a)
        if (bodies[a].topology != nullptr) f(a, a);
    for (const auto& [a, b] : both) f(a, b);
    for (const auto& [a, b] : probed) f(a, b + n);
  };
  std::vector<std::size_t> next(bodies.size() + 1, 0);
  for_each_pair([&](int a, int) { ++next[a + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Candidates> lists(next.back());
  for_each_pair([&](int a, int b) {
    Candidates& list = lists[next[a]++];
    list.body_a = a;
    list.body_b = b;
  });
  return lists;
}

void fill_candidates(std::span<const SurfaceBody> bodies, std::span<const SurfaceBody> fixed,
                     const SearchOptions& o, std::span<Candidates* const> lists) {
  const double margin = compute_margin(o);
  const auto may_touch = [&](const SurfaceBody& a, const SurfaceBody& b) {
    return &a == &b ? may_fold(a) : a.box.grown(margin).overlaps(b.box);
  };
  constexpr std::size_t kWorthThreads = 4;
  for_each_index(lists.size(), lists.size() >= kWorthThreads, [&](std::size_t k) {
    thread_local WideCandidates scratch;
    thread_local ListBuilder builder;
    builder.start(o);
    const SurfaceBody& a = body_at(bodies, fixed, lists[k]->body_a);
    const SurfaceBody& b = body_at(bodies, fixed, lists[k]->body_b);
    scratch.clear();
    if (may_touch(a, b)) builder.fill(a, b, &a == &b, scratch);
    lists[k]->list.assign(scratch);
  });
}

}  // namespace acinus::contact
