#include "geometry/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "geometry/triangulate.hpp"

namespace acinus::geometry {

namespace {

// What the volume below any plane of one direction depends on. Heights are above node 0, so that a
// cell far from the origin keeps its digits.
struct Profile {
  std::vector<double> height;           // [n_node]
  std::vector<double> twice_projected;  // [n_triangle] signed, positive where it faces upward
};

Profile make_profile(std::span<const Vec3> node, Triangles triangle, const Vec3& normal) {
  Profile out;
  for (const Vec3& x : node) out.height.push_back(normal.dot(x - node[0]));
  for (const auto& [a, b, c] : triangle) {
    const Vec3& origin = node[a];
    out.twice_projected.push_back(normal.dot((node[b] - origin).cross(node[c] - origin)));
  }
  return out;
}

struct Below {
  double volume = 0;
  double cut_area = 0;  // what closes the part below; the derivative of the volume
};

Below compute_below(const Profile& profile, Triangles triangle, double level) {
  Below out;
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    std::array<double, 3> h;
    int n_below = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      h[k] = profile.height[triangle[t][k]] - level;
      n_below += h[k] < 0;
    }
    if (n_below == 0) continue;
    double area = 1, height = h[0] + h[1] + h[2];  // as parts of the whole triangle
    if (n_below < 3) {  // the corner that is alone on its side cuts off a smaller triangle
      std::size_t alone = 0;
      while ((h[alone] < 0) != (n_below == 1)) ++alone;
      const double tip = h[alone];
      const double part = tip / (tip - h[(alone + 1) % 3]) * (tip / (tip - h[(alone + 2) % 3]));
      area = n_below == 1 ? part : 1 - part;
      height = n_below == 1 ? part * tip : height - part * tip;
    }
    out.volume += profile.twice_projected[t] * height / 6;
    out.cut_area -= profile.twice_projected[t] * area / 2;
  }
  return out;
}

// Where edges cross the plane, each edge once, and the loops they form.
struct Crossings {
  std::vector<std::array<int, 2>> edge;  // sorted; low, high
  std::vector<std::vector<int>> loop;    // of indices into `edge`

  int find(int i, int j) const {
    const std::array<int, 2> key = {std::min(i, j), std::max(i, j)};
    return static_cast<int>(std::lower_bound(edge.begin(), edge.end(), key) - edge.begin());
  }
};

// The two edges of a triangle that cross the plane: up leads from below to above.
struct Crossing {
  std::array<int, 2> up{}, down{};
};

std::optional<Crossing> find_crossing(const std::array<int, 3>& triangle,
                                      const std::vector<char>& below) {
  Crossing out;
  bool crosses = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int from = triangle[k], to = triangle[(k + 1) % 3];
    const bool from_below = below[from];
    if (from_below == static_cast<bool>(below[to])) continue;
    (from_below ? out.up : out.down) = {from, to};
    crosses = true;
  }
  return crosses ? std::optional(out) : std::nullopt;
}

Crossings find_crossings(Triangles triangle, const std::vector<char>& below) {
  Crossings out;
  std::vector<Crossing> crossing;
  for (const auto& t : triangle) {
    if (const auto found = find_crossing(t, below)) {
      crossing.push_back(*found);
      const auto& [i, j] = found->up;  // the neighbour across it sees it as down
      out.edge.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(out.edge.begin(), out.edge.end());
  std::vector<int> next(out.edge.size(), -1);
  for (const auto& [up, down] : crossing) {
    const std::size_t from = out.find(down[0], down[1]);
    ACINUS_ASSERT(from < next.size() && next[from] < 0);
    next[from] = out.find(up[0], up[1]);
  }
  for (std::size_t first = 0; first < next.size(); ++first) {
    if (next[first] < 0) continue;
    std::vector<int> loop;
    for (auto at = first; next[at] >= 0;) {
      loop.push_back(static_cast<int>(at));
      at = std::exchange(next[at], -1);
    }
    out.loop.push_back(std::move(loop));
  }
  return out;
}

// Ear clipping asks which side of a line a point is on, so points that coincide are cut off first.
std::vector<std::array<int, 3>> triangulate_cap(std::span<const Vec3> rim) {
  check(
      rim.size() <= kMaxPolygon,
      fmt::format("the cut of a cell has {} points, more than the {} allowed. Use a coarser mesh.",
                  rim.size(), kMaxPolygon));
  double length = 0;
  for (std::size_t k = 0; k < rim.size(); ++k)
    length += (rim[(k + 1) % rim.size()] - rim[k]).norm();
  std::vector<int> polygon(rim.size());
  std::iota(polygon.begin(), polygon.end(), 0);
  std::vector<std::array<int, 3>> out;
  const auto x = [&](std::size_t k) { return rim[polygon[k]]; };
  for (std::size_t k = 0; k < polygon.size() && polygon.size() > 3;) {
    const std::size_t n = polygon.size(), next = (k + 1) % n;
    if ((x(next) - x(k)).norm() > 1e-10 * length) {
      ++k;
      continue;
    }
    out.push_back({polygon[(k + n - 1) % n], polygon[k], polygon[next]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(k));
  }
  const auto rest = triangulate(polygon, rim);
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

// The half with `side` (1 below, 0 above), open at the cut; the rim nodes come last.
Surface make_open_half(std::span<const Vec3> node, Triangles triangle,
                       const std::vector<char>& below, char side, const Crossings& crossings,
                       std::span<const Vec3> rim) {
  Surface out;
  std::vector<int> number(node.size(), -1), rim_number(crossings.edge.size(), -1);
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (below[i] != side) continue;
    number[i] = static_cast<int>(out.node.size());
    out.node.push_back(node[i]);
  }
  const int first_rim = static_cast<int>(out.node.size());
  for (std::size_t k = 0; k < rim.size(); ++k)
    rim_number[crossings.loop[0][k]] = first_rim + static_cast<int>(k);
  out.node.insert(out.node.end(), rim.begin(), rim.end());
  for (const auto& t : triangle) {
    std::array<int, 4> corner{};  // of the part on this side, counter-clockwise
    std::size_t n_corner = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = t[k], to = t[(k + 1) % 3];
      if (below[from] == side) corner[n_corner++] = number[from];
      if (below[from] != below[to])
        corner[n_corner++] = rim_number[crossings.find(t[k], t[(k + 1) % 3])];
    }
    if (n_corner >= 3) out.triangle.push_back({corner[0], corner[1], corner[2]});
    if (n_corner == 4) out.triangle.push_back({corner[0], corner[2], corner[3]});
  }
  return out;
}

}  // namespace

double compute_volume_below(std::span<const Vec3> node, Triangles triangle, const CutPlane& plane) {
  if (triangle.empty()) return 0;
  const Profile profile = make_profile(node, triangle, plane.normal);
  return compute_below(profile, triangle, plane.offset - plane.normal.dot(node[0])).volume;
}

std::optional<CutPlane> find_halving_plane(std::span<const Vec3> node, Triangles triangle,
                                           const Vec3& normal) {
  const double volume = triangle.empty() ? 0 : compute_volume(node, triangle);
  if (!(volume > 0) || !std::isfinite(volume)) return std::nullopt;
  const Profile profile = make_profile(node, triangle, normal);
  const auto [lowest, highest] = std::minmax_element(profile.height.begin(), profile.height.end());
  double low = *lowest, high = *highest, level = (low + high) / 2, excess = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Below below = compute_below(profile, triangle, level);
    excess = below.volume - volume / 2;
    if (std::abs(excess) <= 1e-13 * volume) break;
    (excess < 0 ? low : high) = level;
    const double newton = level - excess / below.cut_area;
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (next == level) break;
    level = next;
  }
  if (!(std::abs(excess) <= 1e-10 * volume)) return std::nullopt;
  return CutPlane{normal, normal.dot(node[0]) + level};
}

Cut cut_surface(std::span<const Vec3> node, Triangles triangle, const CutPlane& plane) {
  std::vector<double> height;
  std::vector<char> below;
  for (const Vec3& x : node) {
    height.push_back(plane.normal.dot(x) - plane.offset);
    below.push_back(height.back() < 0);
  }
  const Crossings crossings = find_crossings(triangle, below);
  Cut out;
  for (const std::vector<int>& loop : crossings.loop) {
    std::vector<Vec3>& rim = out.loop.emplace_back();
    for (const int e : loop) {
      const auto [i, j] = crossings.edge[e];
      const std::size_t a = i, b = j;
      rim.push_back(node[a] + height[a] / (height[a] - height[b]) * (node[b] - node[a]));
    }
  }
  if (out.loop.size() != 1) return out;
  const auto cap = triangulate_cap(out.loop[0]);
  for (std::size_t h = 0; h < 2; ++h) {
    out.half[h] = make_open_half(node, triangle, below, h == 0, crossings, out.loop[0]);
    const int first = static_cast<int>(out.half[h].node.size() - out.loop[0].size());
    for (const auto& [a, b, c] : cap)
      out.half[h].triangle.push_back(
          {first + a, first + (h == 0 ? b : c), first + (h == 0 ? c : b)});
  }
  return out;
}

}  // namespace acinus::geometry
