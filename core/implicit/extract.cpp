#include "core/implicit/extract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/threads.hpp"

namespace acinus::implicit {
namespace {

/// A place of the lattice.
using Place = std::array<int, 3>;
constexpr int kBits = 20;  ///< of a coordinate

Place middle(const Place& p, const Place& q) {
  return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
}

/// The middle of two neighbouring places, doubled, names their edge: no two edges share it.
std::uint64_t edge_key(const Place& p, const Place& q) {
  std::uint64_t key = 0;
  for (std::size_t k = 0; k < 3; ++k)
    key = key << (kBits + 1) | static_cast<std::uint64_t>(p[k] + q[k]);
  return key;
}

// Bisection goes round in three: the edge that is cut is the diagonal of a cube, then that of a
// face, then a side; then of a cube half as large. All in sides of that cube:
constexpr std::array<double, 3> kLongest{1.7320508075688772, 1.4142135623730951, 1};
/// How far a tetrahedron reaches from the middle of its longest edge.
constexpr std::array<double, 3> kExtent{0.8660254037844387, 0.7071067811865476, 0.7071067811865476};
/// From one middle to that of the next bisection, summed up over all bisections to come.
constexpr std::array<double, 3> kToGo{2.8660254037844387, 2.3660254037844387, 1.8660254037844387};
/// So near a surface, in sides of the cube at the last bisection, all must be of its size: enough
/// for those one bisection before, which reach kExtent, to be bisected wherever they meet it.
constexpr double kMargin = 0.6;

/// The lattice: root cubes, and how often what is in them may be bisected.
struct CubeLattice {
  Vec3 origin = Vec3::Zero();
  double root = 1;             ///< um, side of the cubes that it starts from
  int halvings = 0;            ///< of that side, until places are one apart
  double spacing = 1;          ///< um, of places
  std::vector<double> side;    ///< [level] um, of the cube that a bisection is in
  std::vector<int> last;       ///< [part] the level at which tetrahedra are small enough
  std::vector<int> last_fine;  ///< [fine ball]
  Place n_root{};

  int unit() const { return 1 << halvings; }
  Vec3 position(const Place& p) const { return origin + spacing * Vec3(p[0], p[1], p[2]); }
  /// How near to what asks for the level `end` the middle of a bisection of this level is
  /// necessary.
  double reach(int end, int level) const {
    if (level >= end) return -1;
    return kToGo[level % 3] * side[level] + (kMargin - kToGo[end % 3]) * side[end];
  }
};

double distance(const FineBall& ball, const Vec3& x) {
  return std::max(0.0, (x - ball.center).norm() - ball.radius);
}

CubeLattice make_lattice(const Shape& shape) {
  Box box;
  for (const Box& b : shape.box) {
    box.include(b.low);
    box.include(b.high);
  }
  const double most = *std::ranges::max_element(shape.size);
  const double extent = (box.high - box.low).maxCoeff();
  constexpr double kMostRoots = 64;
  CubeLattice l;
  l.root = std::max(most, extent / kMostRoots);
  l.origin = box.low - Vec3::Constant(l.root);
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    l.n_root[k] = static_cast<int>(std::ceil((box.high[axis] - l.origin[axis]) / l.root)) + 1;
  }
  double least = most;
  const auto find_level = [&](double size) {
    least = std::min(least, size);
    int level = 0;
    while (kLongest[level % 3] * std::ldexp(l.root, -(level / 3)) > size) ++level;
    l.halvings = std::max(l.halvings, level / 3 + 1);
    return level;
  };
  for (const double size : shape.size) l.last.push_back(find_level(size));
  for (const FineBall& ball : shape.fine) l.last_fine.push_back(find_level(ball.size));
  l.spacing = std::ldexp(l.root, -l.halvings);
  for (int level = 0; level <= 3 * l.halvings; ++level)
    l.side.push_back(std::ldexp(l.root, -(level / 3)));
  const int longest = *std::ranges::max_element(l.n_root);
  check(l.halvings < kBits && (longest << l.halvings) < (1 << kBits),
        fmt::format("triangles of {:.3g} um on a surface {:.3g} um across are too small: no more "
                    "than {} fit side by side. Take larger ones, or leave out what is thin.",
                    least, extent, 1 << kBits));
  return l;
}

/// What one root cube contributes: nodes on edges, some of which other cubes have as well.
struct CubePart {
  std::vector<std::uint64_t> key;  ///< [node]
  std::vector<Vec3> node;
  std::vector<std::array<Vec3, 2>> edge;  ///< ZeroSurface
  std::vector<std::array<int, 3>> triangle;
};

/// A place and the function there.
struct Corner {
  Place place{};
  double value = 0;
  bool is_inside() const { return value < 0; }
};
using Tetrahedron = std::array<Corner, 4>;

/// What matters in and near a root cube, ascending.
struct Nearby {
  std::vector<int> part, fine;
};

class CubeExtraction {
 public:
  CubeExtraction(const Shape& shape, const CubeLattice& lattice)
      : shape_(shape), lattice_(lattice) {}

  CubePart run(const Place& cube, const Nearby& nearby) {
    const int side = lattice_.unit();
    near_ = nearby;
    std::array<Corner, 8> corner;
    for (unsigned c = 0; c < 8; ++c) {
      for (unsigned k = 0; k < 3; ++k)
        corner[c].place[k] = (cube[k] + static_cast<int>(c >> k & 1u)) * side;
      corner[c].value = shape_.value(lattice_.position(corner[c].place), nearby.part);
    }
    // Six tetrahedra about the diagonal, one for each way along three sides.
    for (const auto& [u, v] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 0u}, {1u, 2u}, {2u, 0u}, {2u, 1u}})
      visit({corner[0], corner[1u << u], corner[1u << u | 1u << v], corner[7]}, 0,
            {0, nearby.part.size()}, {0, nearby.fine.size()});
    return std::move(part_);
  }

 private:
  /// Of one array of near_, which grow and shrink with the depth of the bisection.
  struct NearRange {
    std::size_t first, last;
  };
  std::span<const int> span_of(const NearRange& parts) const {
    return std::span(near_.part).subspan(parts.first, parts.last - parts.first);
  }

  /// Bisects a tetrahedron as far as necessary and cuts what comes of it.
  void visit(const Tetrahedron& t, int level, const NearRange& parts, const NearRange& fine) {
    const std::size_t kind = static_cast<std::size_t>(level) % 3, end = 3 - kind;
    const Place place = middle(t[0].place, t[end].place);
    const Vec3 x = lattice_.position(place);
    const double extent = kExtent[kind] * lattice_.side[level];
    const std::size_t first = near_.part.size(), first_fine = near_.fine.size();
    bool bisect = false, outside = true;
    for (std::size_t k = parts.first; k < parts.last; ++k) {
      const int part = near_.part[k];
      const double d = shape_.distance(x, part), far = shape_.reach[part];
      if (d < -extent - far) return near_.part.resize(first);  // all inside
      outside = outside && d > extent + far;
      const double reach = lattice_.reach(lattice_.last[part], level);
      bisect = bisect || std::abs(d) <= reach;
      if (d <= extent + std::max(reach, 2 * far)) near_.part.push_back(part);
    }
    if (!outside) {
      for (std::size_t k = fine.first; k < fine.last; ++k) {
        const int ball = near_.fine[k];
        const double d = distance(shape_.fine[ball], x);
        const double reach = lattice_.reach(lattice_.last_fine[ball], level);
        bisect = bisect || d <= reach;
        if (reach >= 0 && d <= extent + reach) near_.fine.push_back(ball);
      }
      const NearRange near{first, near_.part.size()};
      if (bisect)
        bisect_at(t, end, place, level, near, {first_fine, near_.fine.size()});
      else
        cut(t, near);
    }
    near_.part.resize(first);
    near_.fine.resize(first_fine);
  }

  void bisect_at(const Tetrahedron& t, std::size_t end, const Place& place, int level,
                 const NearRange& near, const NearRange& fine) {
    const Corner z{place, shape_.value(lattice_.position(place), span_of(near))};
    Tetrahedron a = t, b = t;
    a[end] = z;
    for (std::size_t k = 0; k < end; ++k) b[k] = t[k + 1];
    b[end] = z;
    visit(a, level + 1, near, fine);
    visit(b, level + 1, near, fine);
  }

  /// The piece of the surface within one tetrahedron.
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

  /// From an inner to an outer corner any piece is crossed outward: that decides which way round.
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

  /// Regula falsi between the two, halving the value of an end that stays (Illinois), as creases
  /// want it; never at an end, where triangles would have no area.
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

  const Shape& shape_;
  const CubeLattice& lattice_;
  Nearby near_;                                    ///< what is near at each depth after the others
  std::unordered_map<std::uint64_t, int> number_;  ///< [edge]
  CubePart part_;
};

/// Calls back for every root cube that a box meets, with the middle of the cube.
template <class Call>
void for_each_cube(const CubeLattice& l, const Box& box, const Call& call) {
  const auto cube = [&](const Vec3& x, std::size_t k) {
    const int axis = static_cast<int>(k);
    return std::clamp(static_cast<int>(std::floor((x[axis] - l.origin[axis]) / l.root)), 0,
                      l.n_root[k] - 1);
  };
  for (int z = cube(box.low, 2); z <= cube(box.high, 2); ++z)
    for (int y = cube(box.low, 1); y <= cube(box.high, 1); ++y)
      for (int x = cube(box.low, 0); x <= cube(box.high, 0); ++x)
        call(Place{x, y, z}, Vec3(l.origin + l.root * Vec3(x + 0.5, y + 0.5, z + 0.5)));
}

/// Of each root cube that a part is near, in an order that no hash decides.
std::map<Place, Nearby> find_nearby(const Shape& shape, const CubeLattice& l) {
  std::map<Place, Nearby> nearby;
  const double extent = kExtent[0] * l.root;
  for (int part = 0; part < static_cast<int>(shape.box.size()); ++part) {
    const double reach = std::max(l.reach(l.last[part], 0), 2 * shape.reach[part]);
    for_each_cube(l, shape.box[part].grown(reach), [&](const Place& cube, const Vec3& center) {
      if (shape.distance(center, part) <= extent + reach) nearby[cube].part.push_back(part);
    });
  }
  for (int k = 0; k < static_cast<int>(shape.fine.size()); ++k) {
    const FineBall& ball = shape.fine[k];
    const double reach = l.reach(l.last_fine[k], 0);
    const Box box = sphere_box(ball.center, ball.radius + std::max(0.0, reach));
    for_each_cube(l, box, [&](const Place& cube, const Vec3& center) {
      const auto near = nearby.find(cube);
      if (near != nearby.end() && distance(ball, center) <= extent + reach)
        near->second.fine.push_back(k);
    });
  }
  return nearby;
}

}  // namespace

ZeroSurface extract_zero(const Shape& shape, std::size_t most) {
  const CubeLattice lattice = make_lattice(shape);
  const std::map<Place, Nearby> nearby = find_nearby(shape, lattice);
  std::vector<const std::pair<const Place, Nearby>*> cube;
  for (const auto& c : nearby) cube.push_back(&c);
  std::vector<CubePart> part(cube.size());
  std::atomic<std::size_t> n_triangle = 0;
  for_each_index(cube.size(), true, [&](std::size_t k) {
    if (n_triangle > most) return;
    part[k] = CubeExtraction(shape, lattice).run(cube[k]->first, cube[k]->second);
    n_triangle += part[k].triangle.size();
  });
  check(n_triangle <= most,
        fmt::format("the surface needs more than {} triangles. Take larger ones, or leave out what "
                    "is thin.",
                    most));
  ZeroSurface out;
  mesh::Surface& surface = out.surface;
  std::unordered_map<std::uint64_t, int> number;
  std::vector<int> global;
  for (CubePart& p : part) {
    global.resize(p.node.size());
    for (std::size_t k = 0; k < p.node.size(); ++k) {
      const auto [at, fresh] = number.try_emplace(p.key[k], static_cast<int>(surface.node.size()));
      if (fresh) {
        surface.node.push_back(p.node[k]);
        out.edge.push_back(p.edge[k]);
      }
      global[k] = at->second;
    }
    for (const auto& [a, b, c] : p.triangle)
      surface.triangle.push_back({global[a], global[b], global[c]});
    p = {};
  }
  return out;
}

}  // namespace acinus::implicit
