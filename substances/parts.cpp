#include "substances/parts.hpp"

#include <algorithm>
#include <limits>

#include "substances/open_space.hpp"

namespace acinus::substances {
namespace {

/// One entry for each voxel, in their order; covers may have several.
std::vector<CoveredPart> merge(std::vector<CoveredPart> parts) {
  std::ranges::stable_sort(parts, {}, &CoveredPart::at);
  std::vector<CoveredPart> merged;
  for (const CoveredPart& p : parts) {
    if (merged.empty() || merged.back().at != p.at)
      merged.push_back(p);
    else
      merged.back().fraction += p.fraction;
  }
  return merged;
}

/// Part at a voxel; none: the number of parts.
std::size_t part_at(const Parts& parts, std::size_t body, std::size_t voxel) {
  const auto first = parts.voxel.begin() + static_cast<std::ptrdiff_t>(parts.start[body]),
             last = parts.voxel.begin() + static_cast<std::ptrdiff_t>(parts.start[body + 1]),
             at = std::lower_bound(first, last, voxel);
  return at != last && *at == voxel ? static_cast<std::size_t>(at - parts.voxel.begin())
                                    : parts.n();
}

void add_links(const VoxelGrid& grid, const Cover& cover, std::size_t body, Parts& parts) {
  for (int axis = 0; axis < 3; ++axis) {
    VoxelGrid faces = grid;
    ++faces.n[axis];
    for (const CoveredPart& face : cover.face[axis]) {
      std::array<int, 3> above = faces.place(face.at), below = above;
      --below[axis];
      if (below[axis] < 0 || above[axis] == grid.n[axis] || !(face.fraction > 0)) continue;
      const std::size_t a = part_at(parts, body, grid.index(below[0], below[1], below[2])),
                        b = part_at(parts, body, grid.index(above[0], above[1], above[2]));
      if (a < parts.n() && b < parts.n()) parts.inner.push_back({a, b, axis, face.fraction});
    }
  }
}

}  // namespace

std::size_t nearest_part(const VoxelGrid& grid, const Parts& parts, std::size_t body,
                         std::size_t voxel) {
  if (const std::size_t same = part_at(parts, body, voxel); same < parts.n()) return same;
  const auto center = [&](std::size_t v) {
    const auto [i, j, k] = grid.place(v);
    return grid.center(i, j, k);
  };
  const Vec3 from = center(voxel);
  std::size_t best = parts.start[body];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = parts.start[body]; p < parts.start[body + 1]; ++p) {
    const double distance = (center(parts.voxel[p]) - from).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = p;
  }
  return best;
}

void add_body(const VoxelGrid& grid, const Cover& cover, std::span<const VoxelShare> surface,
              double area, Parts& parts) {
  std::vector<CoveredPart> inside = merge(cover.volume);
  std::erase_if(inside, [](const CoveredPart& p) { return p.fraction < kLeastOpen; });
  double volume = 0;
  for (const VoxelShare& s : surface) volume += s.volume;
  if (inside.empty() && !surface.empty())
    inside.push_back({surface.front().voxel, volume / grid.voxel_volume()});
  const std::size_t body = parts.n_body();
  for (const CoveredPart& p : inside) {
    parts.voxel.push_back(p.at);
    parts.volume.push_back(p.fraction * grid.voxel_volume());
  }
  parts.start.push_back(parts.n());
  add_links(grid, cover, body, parts);
  for (const VoxelShare& s : surface)
    parts.membrane.push_back(
        {nearest_part(grid, parts, body, s.voxel), s.voxel, area * s.volume / volume});
}

}  // namespace acinus::substances
