#include "runs/experiments/sections.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::runs {
namespace {

/// Point of the edge i-j in the plane. Both triangles at an edge ask with the lower node first, so
/// that their answers are the same to the bit and outlines close.
Vec2 intersect_edge(const std::vector<Vec3>& node, int i, int j, double z) {
  const Vec3 &a = node[std::min(i, j)], &b = node[std::max(i, j)];
  const double t = (z - a.z()) / (b.z() - a.z());
  return (a + t * (b - a)).head<2>();
}

Outline cut_body(const contact::SurfaceBody& body, double z) {
  Outline out;
  const auto above = [&](int i) { return body.node[i].z() >= z; };
  for (const auto& t : *body.triangle) {
    std::array<Vec2, 2> side;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = t[k], j = t[(k + 1) % 3];
      if (above(i) != above(j)) side[n++] = intersect_edge(body.node, i, j, z);
    }
    if (n == 2) out.side.push_back(side);
  }
  if (out.side.empty()) return out;
  Vec2 low = out.side[0][0], high = low;
  for (const auto& side : out.side)
    for (const Vec2& x : side) low = low.cwiseMin(x), high = high.cwiseMax(x);
  out.center = 0.5 * (low + high);
  out.reach = 0.5 * (high - low).norm();
  return out;
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

std::vector<Section> make_sections(std::span<const contact::SurfaceBody> bodies,
                                   std::span<const Ball> balls, std::span<const double> height) {
  std::vector<Section> sections;
  for (const double z : height) {
    Section s{z, {}};
    for (const contact::SurfaceBody& b : bodies) {
      if (z < b.box.low.z() || z > b.box.high.z()) continue;
      Outline o = cut_body(b, z);
      if (!o.side.empty()) s.outline.push_back(std::move(o));
    }
    for (const Ball& b : balls) {
      const double h = z - b.center.z(), r2 = b.radius * b.radius - h * h;
      if (r2 > 0) s.outline.push_back({b.center.head<2>(), std::sqrt(r2), true, {}});
    }
    sections.push_back(std::move(s));
  }
  return sections;
}

std::vector<Chord> compute_chords(const Outline& o, const Vec2& from, const Vec2& along) {
  const Vec2 to_center = o.center - from;
  const double off = cross(along, to_center);
  if (std::abs(off) > o.reach) return {};
  if (o.round) {
    const double middle = along.dot(to_center), half = std::sqrt(o.reach * o.reach - off * off);
    return {{middle - half, middle + half}};
  }
  std::vector<double> at;
  for (const auto& [p, q] : o.side) {
    const double a = cross(along, p - from), b = cross(along, q - from);
    if ((a < 0) != (b < 0)) at.push_back(along.dot(p - from + a / (a - b) * (q - p)));
  }
  std::ranges::sort(at);
  std::vector<Chord> chords;
  for (std::size_t k = 0; k + 1 < at.size(); k += 2) chords.push_back({at[k], at[k + 1]});
  return chords;
}

std::vector<Chord> covered_pieces(const Section& section, const Vec2& from, const Vec2& along,
                                  double join) {
  std::vector<Chord> all;
  for (const Outline& o : section.outline) {
    const std::vector<Chord> chords = compute_chords(o, from, along);
    all.insert(all.end(), chords.begin(), chords.end());
  }
  std::ranges::sort(all);
  std::vector<Chord> pieces;
  for (const Chord& c : all) {
    if (pieces.empty() || c[0] - pieces.back()[1] >= join)
      pieces.push_back(c);
    else
      pieces.back()[1] = std::max(pieces.back()[1], c[1]);
  }
  return pieces;
}

std::vector<double> slice_heights(double height, int count) {
  std::vector<double> z;
  for (int k = 0; k < count; ++k) z.push_back(height * (k + 0.5) / count);
  return z;
}

}  // namespace acinus::runs
