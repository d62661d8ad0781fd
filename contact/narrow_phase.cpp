/// Narrow phase, find_contacts of candidates.hpp: closest features of a list.

#include <algorithm>

#include "contact/candidates.hpp"
#include "contact/closest.hpp"

namespace acinus::contact {

std::size_t find_contacts(const Candidates& pair, std::span<const SurfaceBody> bodies,
                          std::span<const SurfaceBody> fixed, const SearchOptions& o, double moved,
                          Contacts& out) {
  const CandidateList& list = pair.list;
  const bool self = pair.body_a == pair.body_b;
  const bool is_fixed = static_cast<std::size_t>(pair.body_b) >= bodies.size();
  const int partner = is_fixed ? pair.body_b - static_cast<int>(bodies.size()) : pair.body_b;
  const SurfaceBody& a = body_at(bodies, fixed, pair.body_a);
  const SurfaceBody& b = body_at(bodies, fixed, pair.body_b);
  const double range = self ? o.self_range : o.range, depth = self ? 0 : o.max_depth;
  const double horizon = std::max(range, depth), shift = moved + kRounding;
  const int per_site = points_per_site(o.quadrature);
  PointBlock block;
  int point[PointBlock::kSize];
  std::size_t looked = 0;
  auto flush = [&] {
    find_closest(b, list, shift, horizon, block);
    // On a fixed body, which has no unknowns, the exact place: it may be far from its corners.
    compute_gaps(b, is_fixed ? Place::kExact : Place::kRounded, block);
    for (int i = 0; i < block.n; ++i) {
      if (block.triangle[i] < 0) continue;
      const double gap = block.gap[i];
      if (gap > range || gap < -depth) continue;
      // A fold reached through the cell's own inside is not a contact.
      if (self && gap < 0) continue;
      const std::size_t site = point[i] / per_site;
      const Vec3 facing = site_normal(a, o.quadrature, site);
      if (!are_facing(facing, Vec3(block.outward[0][i], block.outward[1][i], block.outward[2][i])))
        continue;
      out.push_back({.a = pair.body_a,
                     .point = point[i],
                     .b = partner,
                     .triangle = block.triangle[i],
                     .partner = is_fixed ? Partner::kMesh : Partner::kSurface,
                     .place = {block.rounded[0][i], block.rounded[1][i]},
                     .normal = Vec3(block.normal[0][i], block.normal[1][i], block.normal[2][i]),
                     .gap = gap});
    }
    looked += static_cast<std::size_t>(block.n);
    block.n = 0;
  };
  block.n = 0;
  for (std::size_t p = 0; p < list.n_point(); ++p) {
    const double before = static_cast<double>(list.gap_at(p));
    if (before - shift > range || -before - shift > depth) continue;
    const int n = block.n++;
    const Vec3 x = point_position(a, point_stencil(a, o.quadrature, list.point_at(p)));
    for (int m = 0; m < 3; ++m) block.x[3 * n + m] = x[m];
    block.begin[n] = list.begin_of(p);
    block.end[n] = list.end_of(p);
    point[n] = list.point_at(p);
    if (block.n == PointBlock::kSize) flush();
  }
  flush();
  return looked;
}

}  // namespace acinus::contact
