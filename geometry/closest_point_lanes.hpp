#pragma once
/// Closest points of eight triangles to eight points: find_closest_point in lanes, without
/// branches.

#include "core/numbers/lanes.hpp"

namespace acinus::geometry {

/// Closest points of eight triangles.
struct ClosestPointLanes {
  Lane weight_b, weight_c;  ///< barycentric; the first corner has the rest of 1
  Lane squared_distance;    ///< um^2
  /// 1 where the triangle is so flat that find_closest_point_of_sliver is needed, else 0.
  Lane sliver;
};

/// Closest points with the same bits as those of the scalar find_closest_point: same regions, same
/// order of sums.
ACINUS_INLINE ClosestPointLanes find_closest_point_lanes(const Lane3& p, const Lane3& a,
                                                         const Lane3& b, const Lane3& c) {
  const auto least = [](Lane u, Lane v) __attribute__((always_inline))->Lane {
    return u < v ? u : v;
  };
  const auto most = [](Lane u, Lane v) __attribute__((always_inline))->Lane {
    return u > v ? u : v;
  };
  const Lane zero = lane_of(0), one = lane_of(1);
  const Lane3 ab = b - a, ac = c - a, ap = p - a;
  const Lane bb = dot(ab, ab), cc = dot(ac, ac), bc = dot(ab, ac);
  const Lane ab_a = dot(ab, ap), ac_a = dot(ac, ap);
  const Lane scale = most(most(bb, cc), bb + cc - 2.0 * bc);
  const Lane squared_area = bb * cc - bc * bc;

  const Lane ab_b = ab_a - bb, ac_b = ac_a - bc, ab_c = ab_a - bc, ac_c = ac_a - cc;
  const Lane part_a = ab_b * ac_c - ab_c * ac_b;
  const Lane part_b = ab_c * ac_a - ab_a * ac_c;
  const Lane part_c = ab_a * ac_b - ab_b * ac_a;
  // A region is where its number is not positive; the smaller of two numbers is either region. The
  // corners are ends of the edges: a and b of ab, c of ac, what remains of bc.
  const Lane at_a = most(ab_a, ac_a), at_b = most(-ab_b, ac_b - ab_b),
             on_ab = most(most(part_c, -ab_a), ab_b);
  const Lane at_c = most(-ac_c, ab_c - ac_c), on_ac = most(most(part_b, -ac_a), ac_c);
  const Lane ab_region = least(least(at_a, at_b), on_ab), ac_region = least(at_c, on_ac);
  const Lane inside = least(least(part_a, part_b), part_c);
  // Each choice overrides those that the twin asks for later. Compared anew each time: g++ 12 takes
  // the lanes apart to keep an answer.
  const Lane bc_b = ac_b - ab_b, bc_c = ab_c - ac_c;
  Lane part = ac_region <= 0.0 ? ac_a : bc_b, whole = ac_region <= 0.0 ? ac_a - ac_c : bc_b + bc_c;
  part = ab_region <= 0.0 ? ab_a : part;
  whole = ab_region <= 0.0 ? ab_a - ab_b : whole;
  const Lane along = most(least(part / whole, one), zero);
  const Lane inverse = 1.0 / (part_a + part_b + part_c);
  Lane wb = ac_region <= 0.0 ? zero : one - along, wc = ab_region <= 0.0 ? zero : along;
  wb = ab_region <= 0.0 ? along : wb;
  wb = inside > 0.0 ? part_b * inverse : wb;
  wc = inside > 0.0 ? part_c * inverse : wc;

  const Lane3 apart = p - (a + wb * ab + wc * ac);
  return {wb, wc, dot(apart, apart),
          squared_area > 1e-12 * scale * scale ? zero : one};  // NaN counts as flat, as there
}

}  // namespace acinus::geometry
