#include "geometry/implicit/extract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory_resource>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/implicit/cube_extraction.hpp"
#include "geometry/implicit/cube_lattice.hpp"

namespace acinus::geometry {
namespace {

/// Root cube with its surface.
struct RootCube {
  Nearby nearby;
  CubePart part;
  bool is_done = false;
};
/// Root cubes, in an order that does not depend on a hash.
using Cubes = std::map<Place, RootCube>;

/// Calls back for every root cube that a box overlaps, with the centre of the cube.
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

/// Root cubes near any part.
Cubes find_cubes(const Shape& shape, const CubeLattice& l) {
  Cubes cubes;
  for (int part = 0; part < static_cast<int>(shape.box.size()); ++part) {
    const double reach = l.remaining[0] + 2 * shape.reach[part];
    for_each_cube(l, shape.box[part].grown(reach), [&](const Place& cube, const Vec3& center) {
      if (shape.distance(center, part) <= reach) cubes[cube].nearby.part.push_back(part);
    });
  }
  return cubes;
}

/// Adds the fine balls from index `first` on to the cubes near them; cubes in which these may cause
/// further bisections are marked to be done again.
void add_fine(std::span<const FineBall> fine, std::size_t first, const CubeLattice& l,
              Cubes& cubes) {
  for (std::size_t k = first; k < fine.size(); ++k) {
    const FineBall& ball = fine[k];
    const double reach = l.reach(l.last_fine[k], 0);
    const Box box = sphere_box(ball.center, ball.radius + std::max(0.0, reach));
    for_each_cube(l, box, [&](const Place& place, const Vec3& center) {
      const auto near = cubes.find(place);
      if (near == cubes.end() || !is_within(ball, center, reach)) return;
      RootCube& cube = near->second;
      cube.nearby.fine.push_back(static_cast<int>(k));
      const Vec3 apart = (ball.center - center).cwiseAbs().array() - 0.5 * l.root;
      cube.is_done = cube.is_done && apart.cwiseMax(0).norm() - ball.radius >
                                         l.reach(l.last_fine[k], cube.part.coarsest);
    });
  }
}

void extract(const Shape& shape, std::span<const FineBall> fine, const CubeLattice& lattice,
             std::size_t most, bool find_missed, Cubes& cubes) {
  std::vector<Cubes::value_type*> todo;
  std::atomic<std::size_t> n_triangle = 0;
  for (auto& c : cubes)
    if (!c.second.is_done)
      todo.push_back(&c);
    else
      n_triangle += c.second.part.triangle.size();
  for_each_index(todo.size(), true, [&](std::size_t k) {
    if (n_triangle > most) return;
    auto& [place, cube] = *todo[k];
    cube.part = extract_cube(shape, fine, lattice, place, cube.nearby, find_missed);
    cube.is_done = true;
    n_triangle += cube.part.triangle.size();
  });
  check(n_triangle <= most,
        fmt::format("the surface needs more than {} triangles. Take larger ones, or leave out what "
                    "is thin.",
                    most));
}

/// Joined surface of all cubes; nodes that several cubes share become one.
ZeroSurface join(const Cubes& cubes, const CubeLattice& lattice) {
  ZeroSurface out;
  std::pmr::monotonic_buffer_resource memory;
  std::pmr::unordered_map<std::uint64_t, int> number(&memory);  ///< of nodes on cube faces
  std::vector<int> global;
  for (const auto& [place, cube] : cubes) {
    const CubePart& p = cube.part;
    global.resize(p.node.size());
    for (std::size_t k = 0; k < p.node.size(); ++k) {
      global[k] = static_cast<int>(out.surface.node.size());
      if (is_on_face(p.key[k], lattice)) {
        const auto [at, fresh] = number.try_emplace(p.key[k], global[k]);
        global[k] = at->second;
        if (!fresh) continue;
      }
      out.surface.node.push_back(p.node[k]);
      out.edge.push_back(p.edge[k]);
    }
    for (const auto& [a, b, c] : p.triangle)
      out.surface.triangle.push_back({global[a], global[b], global[c]});
  }
  return out;
}

}  // namespace

ZeroSurface extract_zero(const Shape& shape, std::size_t most, const CountFaults& count_faults) {
  constexpr int kMostRounds = 6;
  CubeLattice lattice = make_lattice(shape);
  Cubes cubes = find_cubes(shape, lattice);
  std::vector<FineBall> fine = shape.fine;
  add_fine(fine, 0, lattice, cubes);
  ZeroSurface out;
  long fewest = 0;
  for (int round = 1;; ++round) {
    extract(shape, fine, lattice, most, count_faults != nullptr, cubes);
    ZeroSurface z = join(cubes, lattice);
    const long faults = count_faults ? count_faults(z) : 0;
    if (round == 1 || faults < fewest) {
      fewest = faults;
      out = std::move(z);
    }
    if (fewest == 0 || round == kMostRounds) return out;
    const std::size_t first = fine.size();
    // Gaps first: across these surfaces are joined that should not be. Where a wall bulges between
    // two corners outside there is hardly ever a fault.
    const auto add_missed = [&](bool gap) {
      for (const auto& [place, cube] : cubes)
        for (const MissedEdge& edge : cube.part.missed)
          if (edge.is_gap == gap) fine.push_back(edge.middle);
    };
    add_missed(true);
    if (round > 1 || fine.size() == first) add_missed(false);
    if (fine.size() == first) return out;
    for (std::size_t k = first; k < fine.size(); ++k)
      lattice.last_fine.push_back(lattice.level_of(fine[k].size));
    add_fine(fine, first, lattice, cubes);
  }
}

}  // namespace acinus::geometry
