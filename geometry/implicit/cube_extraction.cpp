#include "geometry/implicit/cube_extraction.hpp"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <unordered_map>
#include <utility>

#include "geometry/implicit/zero_surface.hpp"

namespace acinus::geometry {
namespace {

Place middle(const Place& p, const Place& q) {
  return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
}

/// Unique key of the edge between two neighbouring places: its midpoint, doubled.
std::uint64_t edge_key(const Place& p, const Place& q) {
  std::uint64_t key = 0;
  for (std::size_t k = 0; k < 3; ++k)
    key = key << (kPlaceBits + 1) | static_cast<std::uint64_t>(p[k] + q[k]);
  return key;
}

/// Lattice place with the value of the function.
struct Corner {
  Place place{};
  double value = 0;
  bool is_inside() const { return value < 0; }
};
using Tetrahedron = std::array<Corner, 4>;

class CubeExtraction {
 public:
  CubeExtraction(const Shape& shape, std::span<const FineBall> fine, const CubeLattice& lattice,
                 Nearby nearby, bool find_missed)
      : shape_(shape),
        fine_(fine),
        lattice_(lattice),
        find_missed_(find_missed),
        near_(std::move(nearby)) {}

  CubePart run(const Place& cube) {
    const int side = lattice_.unit();
    const NearRange parts{0, near_.part.size()}, fine{0, near_.fine.size()};
    std::array<Corner, 8> corner;
    for (unsigned c = 0; c < 8; ++c) {
      for (unsigned k = 0; k < 3; ++k)
        corner[c].place[k] = (cube[k] + static_cast<int>(c >> k & 1u)) * side;
      corner[c].value = shape_.value(lattice_.position(corner[c].place), span_of(parts));
    }
    // Six tetrahedra about the diagonal, one for each way along three sides.
    for (const auto& [u, v] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 0u}, {1u, 2u}, {2u, 0u}, {2u, 1u}})
      visit({corner[0], corner[1u << u], corner[1u << u | 1u << v], corner[7]}, 0, parts, fine);
    return std::move(part_);
  }

 private:
  /// Range of one array of near_.
  struct NearRange {
    std::size_t first = 0, last = 0;
  };
  /// Decision about a tetrahedron, with the parts and fine balls near it.
  struct Decision {
    enum class Next { kNothing, kCut, kBisect } next = Next::kNothing;
    double value = 0;  ///< at the midpoint of the longest edge, if bisected there
    NearRange parts, fine;
  };
  std::span<const int> span_of(const NearRange& parts) const {
    return std::span(near_.part).subspan(parts.first, parts.last - parts.first);
  }

  /// Bisects a tetrahedron as far as necessary and cuts the resulting ones.
  void visit(const Tetrahedron& t, int level, const NearRange& parts, const NearRange& fine) {
    const std::size_t end = 3 - level % 3;
    // One decision for all, six to eight, that have this edge.
    const auto [at, fresh] = decision_.try_emplace(edge_key(t[0].place, t[end].place));
    if (fresh) at->second = decide(t[0], t[end], level, parts, fine);
    const Decision d = at->second;
    if (d.next == Decision::Next::kBisect)
      bisect(t, end, level, d);
    else if (d.next == Decision::Next::kCut)
      cut(t, d.parts);
  }

  /// Decides for all tetrahedra with this longest edge. @param a,b  its ends
  Decision decide(const Corner& a, const Corner& b, int level, const NearRange& parts,
                  const NearRange& fine) {
    const Vec3 x = lattice_.position(middle(a.place, b.place));
    const double extent = kExtent[level % 3] * lattice_.side[level];
    bool bisect = false, outside = true;
    distance_.clear();
    for (const int part : span_of(parts)) {
      const double d = shape_.distance(x, part), far = shape_.reach[part];
      if (d < -extent - far) return {};  // all inside
      outside = outside && d > extent + far;
      bisect = bisect || std::abs(d) <= lattice_.reach(lattice_.last[part], level);
      distance_.push_back(d);
    }
    if (outside) return {};
    Decision out;
    out.fine.first = near_.fine.size();
    for (std::size_t k = fine.first; k < fine.last; ++k) {
      const int ball = near_.fine[k];
      if (!is_within(fine_[ball], x, lattice_.reach(lattice_.last_fine[ball], level))) continue;
      bisect = true;
      near_.fine.push_back(ball);
    }
    out.fine.last = near_.fine.size();
    // What matters to this tetrahedron, or to the middles of all that come of it.
    const double farthest = bisect ? lattice_.remaining[level] : extent;
    out.parts.first = near_.part.size();
    for (std::size_t k = 0; k < distance_.size(); ++k) {
      const int part = near_.part[parts.first + k];
      if (distance_[k] <= farthest + 2 * shape_.reach[part]) near_.part.push_back(part);
    }
    out.parts.last = near_.part.size();
    out.next = bisect ? Decision::Next::kBisect : Decision::Next::kCut;
    if (bisect) {
      out.value = shape_.value(x, span_of(out.parts));
      return out;
    }
    part_.coarsest = std::min(part_.coarsest, level);
    if (find_missed_ && a.is_inside() == b.is_inside() && changes_between(a, b, span_of(out.parts)))
      part_.missed.push_back(
          {{x, 0, kMissedSize * kLongest[level % 3] * lattice_.side[level]}, a.is_inside()});
    return out;
  }

  /// True if the function, whose slope is at most 1, has another sign somewhere between two corners
  /// of one sign. Searched in steps as long as its value.
  bool changes_between(const Corner& a, const Corner& b, std::span<const int> parts) const {
    constexpr double kShortest = 0.05;  // of the edge
    const Vec3 from = lattice_.position(a.place), along = lattice_.position(b.place) - from;
    const double length = along.norm(), end = length - std::abs(b.value);
    double at = std::max(std::abs(a.value), kShortest * length);
    while (at < end) {
      const double here = shape_.value(from + at / length * along, parts);
      if ((here < 0) != a.is_inside()) return true;
      at += std::max(std::abs(here), kShortest * length);
    }
    return false;
  }

  void bisect(const Tetrahedron& t, std::size_t end, int level, const Decision& d) {
    const Corner z{middle(t[0].place, t[end].place), d.value};
    Tetrahedron a = t, b = t;
    a[end] = z;
    for (std::size_t k = 0; k < end; ++k) b[k] = t[k + 1];
    b[end] = z;
    visit(a, level + 1, d.parts, d.fine);
    visit(b, level + 1, d.parts, d.fine);
  }

  /// Adds the piece of the surface within one tetrahedron.
  void cut(const Tetrahedron& t, const NearRange& parts) {
    std::array<const Corner*, 4> in{}, out{};
    std::size_t n_in = 0, n_out = 0;
    for (const Corner& c : t) (c.is_inside() ? in[n_in++] : out[n_out++]) = &c;
    if (n_in == 0 || n_out == 0) return;
    const auto node = [&](const Corner* i, const Corner* o) {
      return number_of(*i, *o, span_of(parts));
    };
    const Vec3 outward = lattice_.position(out[0]->place) - lattice_.position(in[0]->place);
    if (n_in == 1) {
      add(outward, node(in[0], out[0]), node(in[0], out[1]), node(in[0], out[2]));
    } else if (n_out == 1) {
      add(outward, node(in[0], out[0]), node(in[1], out[0]), node(in[2], out[0]));
    } else {
      const int a = node(in[0], out[0]), b = node(in[0], out[1]), c = node(in[1], out[1]),
                d = node(in[1], out[0]);
      add(outward, a, b, c);
      add(outward, a, c, d);
    }
  }

  /// Adds a triangle, oriented by `outward`, a vector from an inner to an outer corner.
  void add(const Vec3& outward, int a, int b, int c) {
    const std::vector<Vec3>& x = part_.node;
    const Vec3 normal = (x[b] - x[a]).cross(x[c] - x[a]);
    if (normal.dot(outward) < 0) std::swap(b, c);
    part_.triangle.push_back({a, b, c});
  }

  int number_of(const Corner& in, const Corner& out, std::span<const int> parts) {
    const std::uint64_t key = edge_key(in.place, out.place);
    const auto [at, fresh] = number_.try_emplace(key, static_cast<int>(part_.node.size()));
    if (fresh) {
      part_.key.push_back(key);
      part_.node.push_back(find_zero(in, out, parts));
      part_.edge.push_back({lattice_.position(in.place), lattice_.position(out.place)});
    }
    return at->second;
  }

  /// Zero between two corners by regula falsi, halving the value of an end that stays (Illinois)
  /// because of creases; never at an end, where triangles would have no area.
  Vec3 find_zero(const Corner& in, const Corner& out, std::span<const int> parts) const {
    constexpr double kExact = 0.003;  // of the edge
    constexpr int kRounds = 8;
    const Vec3 a = lattice_.position(in.place), b = lattice_.position(out.place);
    const double exact = kExact * (b - a).norm();
    double low = 0, high = 1, at_low = in.value, at_high = out.value, t = 0.5;
    int stays = 0;  // -1: the low end has just stayed, 1: the high one
    for (int k = 0; k < kRounds; ++k) {
      t = low + (high - low) * at_low / (at_low - at_high);
      const double here = shape_.value(a + t * (b - a), parts);
      if (std::abs(here) < exact) break;
      if (here < 0) {
        low = t;
        at_low = here;
        if (stays == 1) at_high /= 2;
        stays = 1;
      } else {
        high = t;
        at_high = here;
        if (stays == -1) at_low /= 2;
        stays = -1;
      }
    }
    return a + std::clamp(t, kEdgeEnd, 1 - kEdgeEnd) * (b - a);
  }

  static constexpr double kMissedSize = 0.45;  ///< size at a missed edge over its length: bisected
  const Shape& shape_;
  std::span<const FineBall> fine_;
  const CubeLattice& lattice_;
  bool find_missed_;
  std::vector<double> distance_;  ///< of the parts that a decision considers
  Nearby near_;                   ///< of all decisions, one after the other
  std::pmr::monotonic_buffer_resource memory_;
  std::pmr::unordered_map<std::uint64_t, Decision> decision_{&memory_};  ///< [longest edge]
  std::pmr::unordered_map<std::uint64_t, int> number_{&memory_};         ///< [edge]
  CubePart part_;
};

}  // namespace

bool is_within(const FineBall& ball, const Vec3& x, double reach) {
  const double farthest = ball.radius + reach;
  return reach >= 0 && (x - ball.center).squaredNorm() <= farthest * farthest;
}

bool is_on_face(std::uint64_t key, const CubeLattice& lattice) {
  const std::uint64_t within = 2 * static_cast<std::uint64_t>(lattice.unit()) - 1;
  for (int k = 0; k < 3; ++k, key >>= kPlaceBits + 1)
    if ((key & within) == 0) return true;
  return false;
}

CubePart extract_cube(const Shape& shape, std::span<const FineBall> fine,
                      const CubeLattice& lattice, const Place& cube, Nearby nearby,
                      bool find_missed) {
  return CubeExtraction(shape, fine, lattice, std::move(nearby), find_missed).run(cube);
}

}  // namespace acinus::geometry
