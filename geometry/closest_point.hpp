#pragma once
/// Closest point of a triangle to a point. Inline: the narrow phase of contact calls it millions of
/// times a second.

#include <algorithm>

#include "core/vec.hpp"

namespace acinus::geometry {

struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  Vec3 weight =
      Vec3::Zero();  ///< barycentric, each in [0, 1], sum 1: point = sum weight_m corner_m
  double squared_distance = 0;  ///< um^2
};

/// Closest point of a triangle so flat that only its edges count.
ClosestPoint find_closest_point_of_sliver(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c);

/// Closest point of a triangle by corner, edge and face regions after [Ericson2005, section 5.1.5],
/// all from the five products of the edges with each other and with p - a; degenerate triangles are
/// edges or points.
inline ClosestPoint find_closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double bb = ab.squaredNorm(), cc = ac.squaredNorm(), bc = ab.dot(ac);
  const double ab_a = ab.dot(ap), ac_a = ac.dot(ap);
  // Slivers flatter than 1e-12 of their length have no reliable inside: their edges are as close.
  const double scale = std::max({bb, cc, bb + cc - 2 * bc});
  const double squared_area = bb * cc - bc * bc;
  if (!(squared_area > 1e-12 * scale * scale)) return find_closest_point_of_sliver(p, a, b, c);

  const double ab_b = ab_a - bb, ac_b = ac_a - bc, ab_c = ab_a - bc, ac_c = ac_a - cc;
  double wb = 0, wc = 0;
  const double part_a = ab_b * ac_c - ab_c * ac_b;
  const double part_b = ab_c * ac_a - ab_a * ac_c;
  const double part_c = ab_a * ac_b - ab_b * ac_a;
  if (part_a > 0 && part_b > 0 && part_c > 0) {  // the face: most of all calls
    const double inverse = 1 / (part_a + part_b + part_c);
    wb = part_b * inverse;
    wc = part_c * inverse;
  } else if (ab_a <= 0 && ac_a <= 0) {
  } else if (ab_b >= 0 && ac_b <= ab_b) {
    wb = 1;
  } else if (part_c <= 0 && ab_a >= 0 && ab_b <= 0) {
    wb = ab_a / (ab_a - ab_b);
  } else if (ac_c >= 0 && ab_c <= ac_c) {
    wc = 1;
  } else if (part_b <= 0 && ac_a >= 0 && ac_c <= 0) {
    wc = ac_a / (ac_a - ac_c);
  } else {
    const double bc_b = ac_b - ab_b, bc_c = ab_c - ac_c;
    wc = std::clamp(bc_b / (bc_b + bc_c), 0.0, 1.0);
    wb = 1 - wc;
  }
  ClosestPoint out;
  out.weight = Vec3(1 - wb - wc, wb, wc);
  out.point = a + wb * ab + wc * ac;
  out.squared_distance = (p - out.point).squaredNorm();
  return out;
}

}  // namespace acinus::geometry
