#include "service/report/packed_fields.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "service/report/pack.hpp"

namespace acinus::service {
namespace {

std::size_t count(const std::array<int, 3>& n) {
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
         static_cast<std::size_t>(n[2]);
}

/// Voxels along the edge of a block.
int block_edge(const PackedGrid& grid, int axis) {
  return (grid.n_voxel[axis] + grid.n[axis] - 1) / grid.n[axis];
}

/// Voxels between the low corners of the grid and of a frame.
/// @throws Error(kFileError) if the frame is no part of the grid
std::array<int, 3> find_place(const PackedGrid& grid, const io::FieldFrame& frame) {
  constexpr double kSame = 1e-6;  // voxels
  std::array<int, 3> place{};
  bool fits = std::ranges::equal(frame.field, grid.name, {}, &io::VoxelField::name);
  for (int axis = 0; axis < 3; ++axis) {
    const double voxel = grid.size[axis] / grid.n_voxel[axis],
                 at = (frame.origin[axis] - grid.low[axis]) / voxel, most = grid.n_voxel[axis];
    place[axis] = static_cast<int>(std::lround(std::clamp(at, -1.0, most)));
    fits = fits && std::abs(at - place[axis]) <= kSame && place[axis] >= 0 &&
           place[axis] + frame.n[axis] <= grid.n_voxel[axis] &&
           std::abs(frame.spacing[axis] / voxel - 1) <= kSame;
  }
  check(fits, "its fields are not on the grid of the other frames", Exit::kFileError);
  return place;
}

/// Means of a field over the blocks; beyond a frame with a smaller box the nearest voxels.
std::vector<double> block_means(const PackedGrid& grid, const std::array<int, 3>& n,
                                const std::array<int, 3>& place, const std::vector<float>& value) {
  const auto within = [&](int axis, int k) { return std::clamp(k - place[axis], 0, n[axis] - 1); };
  std::vector<double> sum(count(grid.n), 0.0), size(sum.size(), 0.0);
  const std::array<int, 3> edge{block_edge(grid, 0), block_edge(grid, 1), block_edge(grid, 2)};
  for (int k = 0; k < grid.n_voxel[2]; ++k)
    for (int j = 0; j < grid.n_voxel[1]; ++j)
      for (int i = 0; i < grid.n_voxel[0]; ++i) {
        const std::size_t block =
            static_cast<std::size_t>(i / edge[0]) +
            static_cast<std::size_t>(grid.n[0]) *
                (static_cast<std::size_t>(j / edge[1]) +
                 static_cast<std::size_t>(grid.n[1]) * static_cast<std::size_t>(k / edge[2]));
        const int voxel = within(0, i) + n[0] * (within(1, j) + n[1] * within(2, k));
        sum[block] += value[static_cast<std::size_t>(voxel)];
        size[block] += 1;
      }
  for (std::size_t b = 0; b < sum.size(); ++b) sum[b] /= size[b];
  return sum;
}

}  // namespace

PackedGrid make_packed_grid(const io::FieldFrame& frame, std::size_t most) {
  PackedGrid grid;
  if (frame.field.empty()) return grid;
  grid.n_voxel = frame.n;
  grid.low = frame.origin;
  for (const io::VoxelField& f : frame.field) {
    grid.name.push_back(f.name);
    grid.unit.push_back(f.unit);
  }
  for (int edge = 1;; ++edge) {
    for (int axis = 0; axis < 3; ++axis) grid.n[axis] = (frame.n[axis] + edge - 1) / edge;
    if (count(grid.n) * frame.field.size() <= most || count(grid.n) == 1) break;
  }
  for (int axis = 0; axis < 3; ++axis) {
    grid.size[axis] = frame.spacing[axis] * frame.n[axis];
    grid.spacing[axis] = frame.spacing[axis] * block_edge(grid, axis);
  }
  return grid;
}

std::string pack_fields(const PackedGrid& grid, const io::FieldFrame& frame) {
  const std::array<int, 3> place = find_place(grid, frame);
  std::string bytes;
  for (const io::VoxelField& f : frame.field)
    append_levels(bytes, block_means(grid, frame.n, place, f.value));
  return encode_chunk(bytes);
}

}  // namespace acinus::service
