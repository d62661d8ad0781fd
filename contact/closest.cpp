#include "contact/closest.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers/rounding.hpp"
#include "geometry/closest_point.hpp"
#include "geometry/closest_point_lanes.hpp"

namespace acinus::contact {
namespace {

/// Distance below which the closest point gives no normal, um: its weights are rounded to 1e-7 of
/// an edge.
constexpr double kNoDirection = 1e-6;

using Triangle = std::array<int, 3>;

/// Eight vectors from an array [index][3].
ACINUS_INLINE Lane3 gather3(const double* from, const int* index) {
  const double* p[kLanes];
  for (int l = 0; l < kLanes; ++l) p[l] = from + 3 * static_cast<std::ptrdiff_t>(index[l]);
  const auto component = [&p](int m) __attribute__((always_inline))->Lane {
    using Half = double __attribute__((vector_size(4 * sizeof(double))));
    const Half low{p[0][m], p[1][m], p[2][m], p[3][m]}, high{p[4][m], p[5][m], p[6][m], p[7][m]};
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  return {component(0), component(1), component(2)};
}

/// Same corner of eight triangles.
ACINUS_INLINE Lane3 gather_corner(const double* node, const Triangle* triangle, const int* index,
                                  std::size_t corner) {
  int at[kLanes];
  for (int l = 0; l < kLanes; ++l) at[l] = triangle[index[l]][corner];
  return gather3(node, at);
}

/// Pairs of point and triangle to be measured.
struct alignas(64) PointTrianglePairs {
  static constexpr int kSize = 64;
  int n = 0;
  int point[kSize], triangle[kSize];
  std::uint32_t candidate[kSize];
  double weight_b[kSize], weight_c[kSize], squared[kSize], sliver[kSize];
  float distance[kSize];
};

/// Weights and squared distance of all pairs, up to the end of the last eight.
ACINUS_KERNEL void measure(const double* node, const Triangle* triangle, const double* x,
                           PointTrianglePairs& pairs) {
  for (int k = 0; k < pairs.n; k += kLanes) {
    const int* of = pairs.triangle + k;
    const geometry::ClosestPointLanes c = geometry::find_closest_point_lanes(
        gather3(x, pairs.point + k), gather_corner(node, triangle, of, 0),
        gather_corner(node, triangle, of, 1), gather_corner(node, triangle, of, 2));
    store(pairs.weight_b + k, c.weight_b);
    store(pairs.weight_c + k, c.weight_c);
    store(pairs.squared + k, c.squared_distance);
    store(pairs.sliver + k, c.sliver);
    store(pairs.distance + k, lane_sqrt(c.squared_distance));
  }
}

/// Collector of pairs that measures them together and keeps the closest triangle of each point.
/// @tparam List  ListedTriangles or CandidateList
template <class List>
class Measurer {
 public:
  Measurer(const SurfaceBody& b, const List& list, std::span<float> distance, PointBlock& block)
      : b_(b), list_(list), distance_(distance), block_(block) {}

  /// Adds a pair if `wanted`, without a branch.
  void add(int point, std::uint32_t candidate, bool wanted = true) {
    pairs_.point[pairs_.n] = point;
    pairs_.candidate[pairs_.n] = candidate;
    pairs_.triangle[pairs_.n] = list_.triangle_at(candidate);
    pairs_.n += wanted ? 1 : 0;
    if (pairs_.n == PointTrianglePairs::kSize) finish();
  }

  void finish() {
    if (pairs_.n == 0) return;
    const int n = pairs_.n;
    for (int k = n; k % kLanes != 0; ++k) {  // idle lanes repeat the last pair
      pairs_.point[k] = pairs_.point[n - 1];
      pairs_.triangle[k] = pairs_.triangle[n - 1];
    }
    measure(b_.node[0].data(), b_.triangle->data(), block_.x, pairs_);
    for (int k = 0; k < n; ++k) {
      if (pairs_.sliver[k] != 0) measure_sliver(k);
      keep_if_closer(k);
    }
    if (!distance_.empty())
      for (int k = 0; k < n; ++k) distance_[pairs_.candidate[k]] = pairs_.distance[k];
    pairs_.n = 0;
  }

 private:
  void measure_sliver(int k) {
    const Triangle& corner = (*b_.triangle)[pairs_.triangle[k]];
    const geometry::ClosestPoint c = geometry::find_closest_point_of_sliver(
        Eigen::Map<const Vec3>(block_.x + 3 * pairs_.point[k]), b_.node[corner[0]],
        b_.node[corner[1]], b_.node[corner[2]]);
    pairs_.weight_b[k] = c.weight[1];
    pairs_.weight_c[k] = c.weight[2];
    pairs_.squared[k] = c.squared_distance;
    pairs_.distance[k] = static_cast<float>(std::sqrt(c.squared_distance));
  }

  void keep_if_closer(int k) {
    const int point = pairs_.point[k], triangle = pairs_.triangle[k];
    const double squared = pairs_.squared[k], least = block_.squared[point];
    // A tie (an edge that two triangles share) goes to the lower number: the result must not depend
    // on the order of the list, hence on the time at which it was made.
    if (!(squared < least || (squared == least && triangle < block_.triangle[point]))) return;
    block_.squared[point] = squared;
    block_.triangle[point] = triangle;
    block_.weight_b[point] = pairs_.weight_b[k];
    block_.weight_c[point] = pairs_.weight_c[k];
  }

  const SurfaceBody& b_;
  const List& list_;
  std::span<float> distance_;
  PointBlock& block_;
  PointTrianglePairs pairs_;
};

/// Gaps and normals of all points, up to the end of the last eight. @pre all triangles are valid
ACINUS_KERNEL void gap_kernel(const double* node, const double* node_normal,
                              const Triangle* triangle, const int* of, bool exact,
                              PointBlock& block) {
  const Lane one = lane_of(1);
  for (int k = 0; k < block.n; k += kLanes) {
    int corner[3][kLanes], point[kLanes];
    for (int l = 0; l < kLanes; ++l) {
      const Triangle& t = triangle[of[k + l]];
      for (std::size_t m = 0; m < 3; ++m) corner[m][l] = t[m];
      point[l] = k + l;
    }
    const Lane w0 = load<double>(block.rounded[0] + k), w1 = load<double>(block.rounded[1] + k);
    const Lane w2 = one - w0 - w1;
    Lane3 outward = w0 * gather3(node_normal, corner[0]) + w1 * gather3(node_normal, corner[1]) +
                    w2 * gather3(node_normal, corner[2]);
    const Lane length = lane_sqrt(dot(outward, outward));
    const Lane divisor = length > 0.0 ? length : one;
    outward = {outward.x / divisor, outward.y / divisor, outward.z / divisor};

    const Lane3 x = gather3(block.x, point), a = gather3(node, corner[0]),
                b = gather3(node, corner[1]), c = gather3(node, corner[2]);
    Lane3 apart;
    if (exact)
      apart = x - (a + load(block.weight_b + k) * (b - a) + load(block.weight_c + k) * (c - a));
    else
      apart = x - w0 * a - w1 * b - w2 * c;
    const Lane distance = lane_sqrt(dot(apart, apart));
    const Lane side = dot(apart, outward);
    const Lane sign = side >= 0.0 ? one : -one;
    const Lane factor = sign / (distance > kNoDirection ? distance : one);
    store(block.gap + k, sign * distance);
    store(block.outward[0] + k, outward.x);
    store(block.outward[1] + k, outward.y);
    store(block.outward[2] + k, outward.z);
    store(block.normal[0] + k, distance > kNoDirection ? factor * apart.x : outward.x);
    store(block.normal[1] + k, distance > kNoDirection ? factor * apart.y : outward.y);
    store(block.normal[2] + k, distance > kNoDirection ? factor * apart.z : outward.z);
  }
}

template <class List>
void find_closest_of(const SurfaceBody& b, const List& candidates, double shift, double horizon,
                     PointBlock& p, std::span<float> distance) {
  Measurer<List> pairs(b, candidates, distance, p);
  for (int i = 0; i < p.n; ++i) {
    p.squared[i] = horizon * horizon;
    p.triangle[i] = -1;
    p.weight_b[i] = p.weight_c[i] = 0;
    pairs.add(i, p.begin[i]);
  }
  pairs.finish();
  for (int i = 0; i < p.n; ++i) {
    const double reach = std::sqrt(p.squared[i]) + shift;
    for (std::uint32_t k = p.begin[i] + 1; k < p.end[i]; ++k)
      pairs.add(i, k, static_cast<double>(candidates.bound_at(k)) <= reach);
  }
  pairs.finish();
  for (int i = 0; i < p.n; ++i) {
    p.rounded[0][i] = round_to_float(1 - p.weight_b[i] - p.weight_c[i]);
    p.rounded[1][i] = round_to_float(p.weight_b[i]);
  }
}

}  // namespace

void find_closest(const SurfaceBody& b, const ListedTriangles& candidates, double shift,
                  double horizon, PointBlock& block, std::span<float> distance) {
  find_closest_of(b, candidates, shift, horizon, block, distance);
}

void find_closest(const SurfaceBody& b, const CandidateList& candidates, double shift,
                  double horizon, PointBlock& block) {
  find_closest_of(b, candidates, shift, horizon, block, {});
}

void compute_gaps(const SurfaceBody& b, Place place, PointBlock& p) {
  alignas(64) int of[PointBlock::kSize];
  for (int i = 0; i < p.n; ++i) of[i] = std::max(p.triangle[i], 0);
  for (int i = p.n; i % kLanes != 0; ++i) {  // idle lanes use a corner
    of[i] = 0;
    for (int m = 0; m < 3; ++m) p.x[3 * i + m] = 0;
    p.weight_b[i] = p.weight_c[i] = 0;
    p.rounded[0][i] = p.rounded[1][i] = 0;
  }
  gap_kernel(b.node[0].data(), b.node_normal[0].data(), b.triangle->data(), of,
             place == Place::kExact, p);
}

}  // namespace acinus::contact
