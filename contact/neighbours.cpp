#include "contact/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/numbers/lanes.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"
#include "geometry/box_pairs.hpp"

namespace acinus::contact {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Vec3 center(const double* position, std::size_t i) {
  return load_point(position, make_address(i / kLanes, static_cast<int>(i % kLanes)));
}

/// Spheres sorted by the grid cell of their centre; cells in x run side by side.
struct PointGrid {
  Vec3 low;
  double width = 1;
  std::array<std::int64_t, 3> n{};
  std::vector<std::uint32_t> start;  ///< [cells + 1]
  std::vector<std::int32_t> item;

  std::array<std::int64_t, 3> cell_of(const Vec3& x) const {
    std::array<std::int64_t, 3> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = std::clamp<std::int64_t>(
          static_cast<std::int64_t>((x[static_cast<int>(k)] - low[static_cast<int>(k)]) / width), 0,
          n[k] - 1);
    return c;
  }
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * n[1] + y) * n[0] + x);
  }
};

bool is_absent(std::span<const std::uint8_t> ghost, std::size_t i) {
  return !ghost.empty() && ghost[i] == kAbsentSphere;
}

/// Grid of the spheres; empty (no cells) when they are so scattered that most of it would be.
PointGrid make_grid(const double* position, std::span<const double> radius, double margin,
                    std::span<const std::uint8_t> ghost) {
  PointGrid g;
  Box box;
  double largest = 0;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    if (is_absent(ghost, i)) continue;
    box.include(center(position, i));
    largest = std::max(largest, radius[i]);
  }
  g.low = box.low;
  g.width = 2 * largest + margin;
  double cells = 1;
  for (int k = 0; k < 3; ++k) {
    const double n = std::floor((box.high[k] - box.low[k]) / g.width) + 1;
    cells *= n;
    if (!(cells <= 8.0 * static_cast<double>(radius.size()) + 1000)) return g;
    g.n[k] = static_cast<std::int64_t>(n);
  }
  g.start.assign(static_cast<std::size_t>(cells) + 1, 0);
  auto at = [&](std::size_t i) {
    const auto c = g.cell_of(center(position, i));
    return g.index(c[0], c[1], c[2]);
  };
  for (std::size_t i = 0; i < radius.size(); ++i)
    if (!is_absent(ghost, i)) ++g.start[at(i) + 1];
  for (std::size_t k = 1; k < g.start.size(); ++k) g.start[k] += g.start[k - 1];
  g.item.resize(g.start.back());
  for (std::size_t i = radius.size(); i-- > 0;) {  // backwards, so that cells hold ascending items
    if (is_absent(ghost, i)) continue;
    const std::size_t c = at(i);
    g.item[--g.start[c + 1]] = static_cast<std::int32_t>(i);
  }
  // what was counted down is each cell's first item, one place too late
  g.start.erase(g.start.begin());
  g.start.push_back(static_cast<std::uint32_t>(g.item.size()));
  return g;
}

bool are_near(const double* position, std::span<const double> radius, double margin, std::size_t i,
              std::size_t j) {
  const double reach = radius[i] + radius[j] + margin;
  return (center(position, i) - center(position, j)).squaredNorm() <= reach * reach;
}

}  // namespace

void find_sphere_pairs(const double* position, std::span<const double> radius, double margin,
                       std::span<const std::uint8_t> ghost, Pairs& pairs) {
  pairs.clear();
  if (radius.size() < 2) return;
  const auto is_ghost = [&](std::size_t i) { return !ghost.empty() && ghost[i] != 0; };
  const PointGrid g = make_grid(position, radius, margin, ghost);
  if (g.start.empty()) {
    std::vector<Box> boxes;
    std::vector<int> sphere;
    for (std::size_t i = 0; i < radius.size(); ++i) {
      if (is_absent(ghost, i)) continue;
      boxes.push_back(sphere_box(center(position, i), radius[i]));
      sphere.push_back(static_cast<int>(i));
    }
    pairs = geometry::find_pairs(boxes, margin);
    for (auto& [i, j] : pairs) {
      i = sphere[static_cast<std::size_t>(i)];
      j = sphere[static_cast<std::size_t>(j)];
    }
    std::erase_if(pairs, [&](const auto& p) {
      return (is_ghost(p.first) && is_ghost(p.second)) ||
             !are_near(position, radius, margin, p.first, p.second);
    });
    return;
  }
  const auto n_part = static_cast<std::size_t>(thread_count());
  std::vector<Pairs> part(n_part), before(n_part);  // before: of ghost ones with later own ones
  const bool is_first = pairs.capacity() == 0;
  part[0] = std::move(pairs);
  for_each_part(n_part, [&](std::size_t k) {
    // A packed sphere has 12 neighbours, half of them its own.
    if (ghost.empty() && (k > 0 || is_first)) part[k].reserve(7 * radius.size() / n_part);
    for (std::size_t i = k * radius.size() / n_part; i < (k + 1) * radius.size() / n_part; ++i) {
      if (is_ghost(i)) continue;
      const auto c = g.cell_of(center(position, i));
      const std::size_t first = part[k].size();
      for (std::int64_t z = std::max<std::int64_t>(c[2] - 1, 0);
           z <= std::min(c[2] + 1, g.n[2] - 1); ++z)
        for (std::int64_t y = std::max<std::int64_t>(c[1] - 1, 0);
             y <= std::min(c[1] + 1, g.n[1] - 1); ++y) {
          const std::size_t from = g.index(std::max<std::int64_t>(c[0] - 1, 0), y, z);
          const std::size_t to = g.index(std::min(c[0] + 1, g.n[0] - 1), y, z);
          for (std::uint32_t e = g.start[from]; e < g.start[to + 1]; ++e) {
            const std::size_t j = g.item[e];
            if (j <= i && (ghost.empty() || j == i || ghost[j] == 0)) continue;
            if (!are_near(position, radius, margin, i, j)) continue;
            if (j > i) {
              make_room(part[k], 1);
              part[k].emplace_back(static_cast<int>(i), static_cast<int>(j));
            } else {
              before[k].emplace_back(static_cast<int>(j), static_cast<int>(i));
            }
          }
        }
      std::sort(part[k].begin() + static_cast<std::ptrdiff_t>(first), part[k].end());
    }
  });
  pairs = std::move(part[0]);
  for (std::size_t k = 1; k < n_part; ++k)
    pairs.insert(pairs.end(), part[k].begin(), part[k].end());
  if (!ghost.empty()) {
    const auto n_own = static_cast<std::ptrdiff_t>(pairs.size());
    for (const Pairs& p : before) pairs.insert(pairs.end(), p.begin(), p.end());
    std::sort(pairs.begin() + n_own, pairs.end());
    std::inplace_merge(pairs.begin(), pairs.begin() + n_own, pairs.end());
  }
  // The list is kept, and spheres at a surface have fewer neighbours.
  if (pairs.capacity() > pairs.size() + pairs.size() / 8) pairs.shrink_to_fit();
}

}  // namespace acinus::contact
