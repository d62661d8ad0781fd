#pragma once
/// Crossings of lines parallel to an axis with a closed surface of triangles.

#include <algorithm>
#include <array>
#include <span>

#include "core/vec.hpp"

namespace acinus::substances {

/// Place of a node across the lines, with its number.
struct ProjectedNode {
  int index;
  double u, v;
};

/// Position of a point relative to the directed edge a -> b, seen against the lines: +1 left,
/// -1 right. Both triangles of an edge get opposite answers, also for points on it.
inline int side_of(const ProjectedNode& a, const ProjectedNode& b, double u, double v) {
  const bool flipped = a.index > b.index;
  const ProjectedNode &p = flipped ? b : a, &q = flipped ? a : b;
  const double e = (q.u - p.u) * (v - p.v) - (q.v - p.v) * (u - p.u);
  return (e >= 0) != flipped ? 1 : -1;
}

/// Calls f(u line, v line, height, turn) for every crossing; turn is +1 where a line leaves the
/// inside, -1 where it enters.
/// @param along  axis of the lines; u and v are the two axes that follow it
/// @param us, vs  places of the lines: at(number), first(least coordinate), end()
template <class Us, class Vs, class F>
void for_each_crossing(std::span<const Vec3> node, std::span<const std::array<int, 3>> triangle,
                       int along, const Us& us, const Vs& vs, const F& f) {
  const int u_axis = (along + 1) % 3, v_axis = (along + 2) % 3;
  for (const auto& t : triangle) {
    const Vec3 &a = node[t[0]], &b = node[t[1]], &c = node[t[2]];
    const Vec3 normal = (b - a).cross(c - a);
    if (normal[along] == 0) continue;
    const ProjectedNode p{t[0], a[u_axis], a[v_axis]}, q{t[1], b[u_axis], b[v_axis]},
        r{t[2], c[u_axis], c[v_axis]};
    const double u_end = std::max({p.u, q.u, r.u}), v_end = std::max({p.v, q.v, r.v});
    const int turn = normal[along] > 0 ? 1 : -1;
    for (long j = vs.first(std::min({p.v, q.v, r.v})); j < vs.end() && vs.at(j) <= v_end; ++j)
      for (long i = us.first(std::min({p.u, q.u, r.u})); i < us.end() && us.at(i) <= u_end; ++i) {
        const double u = us.at(i), v = vs.at(j);
        if (side_of(p, q, u, v) != turn || side_of(q, r, u, v) != turn ||
            side_of(r, p, u, v) != turn)
          continue;
        const double w =
            a[along] -
            ((u - a[u_axis]) * normal[u_axis] + (v - a[v_axis]) * normal[v_axis]) / normal[along];
        f(i, j, w, turn);
      }
  }
}

}  // namespace acinus::substances
