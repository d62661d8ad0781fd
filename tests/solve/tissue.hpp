#pragma once
/// Cells with meshes that touch in every way contacts can join.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/topology.hpp"
#include "tests/solve/systems.hpp"

namespace acinus::solve {

/// Faces of a cell, and a pattern with all their edges as springs.
struct Mesh {
  std::vector<std::array<int, 3>> triangle;
  BlockPattern pattern;
};

/// Springs and faces, no hinges. Points 4 and 5 are the poles; a spring may start at either end.
inline Mesh make_octahedron() {
  Mesh m;
  m.triangle = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  m.pattern = {6,
               {{0, 1},
                {2, 1},
                {2, 3},
                {0, 3},
                {4, 0},
                {1, 4},
                {4, 2},
                {3, 4},
                {5, 0},
                {1, 5},
                {2, 5},
                {5, 3}},
               {},
               m.triangle};
  return m;
}
inline Mesh make_indexed_octahedron() {
  Mesh m = make_octahedron();
  index_springs(m.pattern);
  return m;
}

/// Springs and hinges, no faces.
inline Mesh make_icosphere(int n_node) {
  const geometry::Topology& t = geometry::shared_icosphere(n_node);
  Mesh m{t.triangle, {t.n_node, t.edge, {}, {}}};
  for (const auto& h : t.hinge) m.pattern.wing.push_back({h[0], h[1]});
  index_springs(m.pattern);
  return m;
}

/// Body on one side of a contact. A loose cell has no index of its springs.
enum Shape : std::size_t { kOctahedron, kIcosphere, kLoose, kSphere, kOutside };

inline const Mesh& mesh_of(Shape shape) {
  static const Mesh meshes[] = {
      make_indexed_octahedron(), make_icosphere(12), make_octahedron(), {{}, kSingle}};
  return meshes[shape];
}

enum class Part { kFace, kPoint };
struct Kind {
  const char* name;
  Shape a;
  Part part_a;
  Shape b;
  Part part_b;
  bool is_merged;
  bool within = false;  ///< both sides are on the same cell
};
inline constexpr Kind kKinds[] = {
    {"face, face", kOctahedron, Part::kFace, kIcosphere, Part::kFace, true},
    {"face, face of a lower cell", kIcosphere, Part::kFace, kOctahedron, Part::kFace, true},
    {"face, face of the same mesh", kIcosphere, Part::kFace, kIcosphere, Part::kFace, true},
    {"face, node", kOctahedron, Part::kFace, kIcosphere, Part::kPoint, true},
    {"face, node of a lower cell", kIcosphere, Part::kFace, kOctahedron, Part::kPoint, true},
    {"face, node of a loose cell", kIcosphere, Part::kFace, kLoose, Part::kPoint, true},
    {"face, sphere", kIcosphere, Part::kFace, kSphere, Part::kPoint, true},
    {"face, face of its own cell", kIcosphere, Part::kFace, kIcosphere, Part::kFace, true, true},
    {"face, node of its own cell", kOctahedron, Part::kFace, kOctahedron, Part::kPoint, true, true},
    {"face, loose face", kOctahedron, Part::kFace, kLoose, Part::kFace, false},
    {"loose face, face", kLoose, Part::kFace, kOctahedron, Part::kFace, false},
    {"loose face, sphere", kLoose, Part::kFace, kSphere, Part::kPoint, false},
    {"node, face", kOctahedron, Part::kPoint, kIcosphere, Part::kFace, false},
    {"node, node", kIcosphere, Part::kPoint, kOctahedron, Part::kPoint, false},
    {"sphere, sphere", kSphere, Part::kPoint, kSphere, Part::kPoint, false},
    {"node, face of its own cell", kIcosphere, Part::kPoint, kIcosphere, Part::kFace, false, true},
    {"face, boundary", kIcosphere, Part::kFace, kOutside, Part::kPoint, false},
    {"node, boundary", kOctahedron, Part::kPoint, kOutside, Part::kPoint, false},
};

/// Blocks of every shape, and contacts between their cells.
class Tissue {
 public:
  /// @param n_block  of each shape
  Tissue(std::uint64_t seed, std::size_t n_block)
      : random_(reference::stream(seed)), n_block_(n_block) {
    system.friction_scale = 0.7;
    system.stiffness_scale = 1.3;
    std::vector<Block> blocks;
    for (const Shape shape : {kOctahedron, kIcosphere, kLoose, kSphere})
      blocks.insert(blocks.end(), n_block, block_of(mesh_of(shape).pattern));
    set_blocks(system, blocks);
  }

  /// Everything but contacts.
  void add_elements() {
    for (double& m : system.medium) m = random_.uniform(0.05, 0.2);
    fill_elements(system, random_);
    RankOne family{RowVector<float>(system.n_dof()),
                   std::vector<double>(system.block.size() * kLanes)};
    for (float& v : family.vector) v = static_cast<float>(random_.uniform(-1, 1));
    for (double& v : family.coefficient) v = random_.uniform(0, 0.5);
    system.rank_one.push_back(family);
  }

  /// Contacts of two cells. Two faces meet in both orders, in turn, so that the contacts of the two
  /// cells are not all in a row; some have no matrix, or half of one.
  void add_contacts(const Kind& kind) {
    const std::size_t a = cell(kind.a);
    std::size_t b = kind.within ? a : cell(kind.b);
    while (!kind.within && b == a) b = cell(kind.b);
    for (std::size_t k = 0; k < 7; ++k) {
      Link link;
      link.a = side(a, kind.a, kind.part_a);
      if (kind.b != kOutside) link.b = side(b, kind.b, kind.part_b);
      if (kind.part_a == Part::kFace && kind.part_b == Part::kFace && k % 3 == 2 &&
          mesh_of(kind.a).pattern.spring_of.empty() == mesh_of(kind.b).pattern.spring_of.empty())
        std::swap(link.a, link.b);
      const double stiffness = random_.uniform(0, 1), friction = random_.uniform(0, 0.5);
      set_law(k == 3 || k == 4 ? 0 : stiffness, k == 4 || k == 5 ? 0 : friction, 0,
              random_.unit_vector(), link);
      system.links.link.push_back(link);
      system.links.law.push_back({});
    }
  }
  void add_point_contact() {
    const auto n = system.n_row * kLanes;
    const auto a = static_cast<Point>(random_.index(n));
    const auto b = static_cast<Point>((a + 1 + random_.index(n - 1)) % n);
    const Vec3 normal = random_.unit_vector();
    const double stiffness = random_.uniform(0, 1), friction = random_.uniform(0, 0.5);
    system.point_links.push_back(make_point_link(a, b, normal, stiffness, friction));
  }

  System system;

 private:
  std::size_t cell(Shape shape) {
    return shape == kOutside
               ? static_cast<std::size_t>(-1)
               : (shape * n_block_ + random_.index(n_block_)) * kLanes + random_.index(kLanes);
  }
  Side side(std::size_t cell, Shape shape, Part part) {
    const Mesh& m = mesh_of(shape);
    auto point = [&](std::size_t i) {
      return static_cast<Point>((system.block[cell / kLanes].first_row + i) * kLanes +
                                cell % kLanes);
    };
    if (part == Part::kPoint) return Side::at(point(random_.index(m.pattern.n_point)));
    const auto& t = m.triangle[random_.index(m.triangle.size())];
    const std::size_t first = random_.index(3);  // a face may be named from any of its corners
    Side s;
    for (std::size_t k = 0; k < 3; ++k) s.point[k] = point(t[(first + k) % 3]);
    const double u = random_.uniform(), v = random_.uniform();
    s.weight = {static_cast<float>(std::min(u, v)), static_cast<float>(std::abs(u - v))};
    return s;
  }

  UniformStream random_;
  std::size_t n_block_;
};

/// Everything in it, with contacts of all kinds.
inline System make_tissue(std::uint64_t seed, std::size_t n_block = 2) {
  Tissue t(seed, n_block);
  t.add_elements();
  for (std::size_t k = 0; k < 3 * n_block; ++k) {
    for (const Kind& kind : kKinds) t.add_contacts(kind);
    for (int i = 0; i < 5; ++i) t.add_point_contact();
  }
  return t.system;
}

}  // namespace acinus::solve
