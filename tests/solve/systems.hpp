#pragma once
/// Random positive definite system with everything in it.

#include <algorithm>
#include <vector>

#include "solve/operator.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::solve {

/// Springs and faces, no hinges; all three; a sphere.
inline const BlockPattern kFive{
    5, {{0, 1}, {1, 2}, {0, 4}, {3, 4}, {1, 3}}, {}, {{0, 1, 2}, {4, 3, 1}}};
inline const BlockPattern kSeven{7,
                                 {{0, 6}, {2, 5}, {1, 4}, {0, 3}, {5, 6}, {2, 3}},
                                 {{3, 5}, {3, 6}, {0, 2}, {6, 2}, {0, 2}, {5, 0}},
                                 {{0, 6, 3}, {2, 5, 1}, {4, 1, 0}},
                                 {}};
inline const BlockPattern kSingle{1, {}, {}, {}};

inline Block block_of(const BlockPattern& pattern) {
  Block block;
  block.pattern = &pattern;
  return block;
}

/// Fills the elements within the cells. A spring may be softer along its direction than across.
inline void fill_elements(System& s, UniformStream& random) {
  for (float& v : s.shape) v = static_cast<float>(random.uniform(-0.6, 0.6));
  constexpr double kLongest2 = 3 * 1.2 * 1.2;  // um^2, squared length of a spring of that shape
  for (std::size_t at = 0; at < s.spring.size(); at += kSpringStride)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double across = random.uniform(0, 0.5);
      const bool is_softer = random.uniform() < 0.3;
      const double more =
          is_softer ? -random.uniform(0, 0.9) * across / kLongest2 : random.uniform();
      s.spring[at + l] = static_cast<float>(more);
      s.spring[at + kLanes + l] = static_cast<float>(across);
    }
  for (float& v : s.face) v = static_cast<float>(random.uniform(-0.7, 0.7));
  for (float& v : s.hinge)  // not near 0, which would leave cells with soft modes
    v = static_cast<float>(random.uniform(0.7, 1.3) * (random.uniform() < 0.5 ? -1 : 1));
}

inline PointLink make_point_link(Point a, Point b, const Vec3& normal, double stiffness,
                                 double friction) {
  return {a,
          b,
          {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
           static_cast<float>(normal.z())},
          static_cast<float>(stiffness),
          static_cast<float>(friction)};
}

/// Picks the places that contacts join.
class Places {
 public:
  Places(const System& s, UniformStream& random) : s_(s), random_(random) {}
  /// Starts a new contact: no contact names a point twice.
  void start() { used_.clear(); }
  Point point() {
    for (;;) {
      const auto p = static_cast<Point>(random_.index(s_.n_row * kLanes));
      if (take(p)) return p;
    }
  }
  /// One point or, if there is room in the cell, three.
  Side side(bool three) {
    const Point p = point();
    const auto row = static_cast<std::size_t>(p) / kLanes;
    const Block block = s_.block[s_.block.block_of_row(row)];
    std::vector<Point> room;
    for (std::size_t i = 0; i < static_cast<std::size_t>(block.pattern->n_point); ++i) {
      const auto q = static_cast<Point>((block.first_row + i) * kLanes + p % kLanes);
      if (std::ranges::count(used_, q) == 0) room.push_back(q);
    }
    if (!three || room.size() < 2) return Side::at(p);
    Side side{{p, p, p}, {}};
    for (std::size_t m = 1; m < 3; ++m) {
      const auto k = static_cast<std::ptrdiff_t>(random_.index(room.size()));
      side.point[m] = room[k];
      take(side.point[m]);
      room.erase(room.begin() + k);
    }
    const double u = random_.uniform(), v = random_.uniform();
    side.weight = {static_cast<float>(std::min(u, v)), static_cast<float>(std::abs(u - v))};
    return side;
  }

 private:
  bool take(Point p) {
    if (std::ranges::count(used_, p) > 0) return false;
    used_.push_back(p);
    return true;
  }
  const System& s_;
  UniformStream& random_;
  std::vector<Point> used_;
};

/// Two groups of deformable cells and two rows of spheres; two rank-one families, the second of
/// which covers the first group only; contacts of one and of three points a side, with boundary
/// and within a single cell; contacts of spheres.
/// @param copies  more groups than that: enough rows for threads to start
inline System make_system(std::uint64_t seed, int copies = 1) {
  auto random = reference::stream(seed);
  System s;
  s.friction_scale = 0.7;
  s.stiffness_scale = 1.3;
  std::vector<Block> blocks{block_of(kFive)};
  for (int k = 0; k < copies; ++k) blocks.push_back(block_of(kSeven));
  for (int k = 0; k < 2; ++k) blocks.push_back(block_of(kSingle));
  set_blocks(s, blocks);
  for (double& m : s.medium) m = random.uniform(0.05, 0.2);
  fill_elements(s, random);
  for (std::size_t n_block : {s.block.size(), std::size_t{1}}) {
    const std::size_t rows = n_block > 1 ? s.n_row : 5;
    RankOne family{RowVector<float>(rows * kPointStride), std::vector<double>(n_block * kLanes)};
    for (float& v : family.vector) v = static_cast<float>(random.uniform(-1, 1));
    for (double& v : family.coefficient) v = random.uniform(0, 0.5);
    s.rank_one.push_back(family);
  }
  Places places(s, random);
  for (int k = 0; k < 60 * copies; ++k) {
    places.start();
    Link link;
    link.a = places.side(random.uniform() < 0.7);
    if (k % 5 != 0) link.b = places.side(random.uniform() < 0.7);
    if (k % 11 == 7) {  // a cell that meets itself
      const auto row = static_cast<Point>(s.block[1].first_row);
      const Point lane = static_cast<Point>(random.index(kLanes));
      const auto at = [&](Point i) { return (row + i) * kLanes + lane; };
      link.a = {{at(4), at(0), at(2)}, {0.25f, 0.6f}};
      link.b = {{at(6), at(1), at(5)}, {0.1f, 0.2f}};
    }
    const bool only_pulls = k % 7 == 3;  // no matrix: cohesive softening beyond the friction range
    const double stiffness = random.uniform(0, 1), friction = random.uniform(0, 0.5);
    const Vec3 normal = random.unit_vector();
    set_law(only_pulls ? 0 : stiffness, only_pulls ? 0 : friction, random.uniform(-1, 1), normal,
            link);
    s.links.link.push_back(link);
    s.links.law.push_back({});
  }
  for (int k = 0; k < 20 * copies; ++k) {
    places.start();
    const Point a = places.point(), b = k % 5 != 0 ? places.point() : kNowhere;
    const Vec3 normal = random.unit_vector();
    const bool only_pulls = k % 7 == 3;
    const double stiffness = only_pulls ? 0 : random.uniform(0, 1),
                 friction = only_pulls ? 0 : random.uniform(0, 0.5);
    s.point_links.push_back(make_point_link(a, b, normal, stiffness, friction));
  }
  return s;
}

/// Force of a link of such a system, nN.
inline Vec3 force_of(const Link& l) {
  return static_cast<double>(l.gap) * Vec3(l.normal[0], l.normal[1], l.normal[2]);
}

/// Without what acts from outside: medium, boundary and the whole-cell families (whose random
/// vectors, unlike those of volume and area, feel a translation).
inline System keep_inner(System s) {
  std::ranges::fill(s.medium, 0.0);
  s.rank_one.clear();
  for (Link& l : s.links.link)
    if (!l.b.exists()) l.stiffness = l.friction = 0;
  for (PointLink& l : s.point_links)
    if (l.b == kNowhere) l.stiffness = l.friction = 0;
  return s;
}

/// System of which one kind of element or contact is left.
struct Alone {
  const char* kind;
  System system;
};
/// One after the other, each kind by itself: a mistake in one must not hide behind the others.
inline std::vector<Alone> make_each_alone(const System& all) {
  System none = all;
  std::ranges::fill(none.medium, 0.0);
  for (auto* element : {&none.spring, &none.hinge, &none.face}) std::ranges::fill(*element, 0.0f);
  none.rank_one.clear();
  none.links.clear();
  none.point_links.clear();
  std::vector<Alone> list;
  auto add = [&](const char* kind, auto System::*part) {
    list.push_back({kind, none});
    list.back().system.*part = all.*part;
  };
  add("medium", &System::medium);
  add("spring", &System::spring);
  add("hinge", &System::hinge);
  add("face", &System::face);
  add("rank one", &System::rank_one);
  add("links", &System::links);
  add("point links", &System::point_links);
  return list;
}

template <class T = double>
std::vector<T> random_vector_of(const System& s, std::uint64_t seed) {
  auto random = reference::stream(seed);
  std::vector<T> v(s.n_dof());
  for (T& x : v) x = static_cast<T>(random.uniform(-1, 1));
  return v;
}

template <class V>
Eigen::Map<const Eigen::VectorXd> as_eigen(const V& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}
inline Eigen::VectorXd as_eigen(const std::vector<float>& v) {
  return Eigen::Map<const Eigen::VectorXf>(v.data(), static_cast<Eigen::Index>(v.size()))
      .cast<double>();
}

}  // namespace acinus::solve
