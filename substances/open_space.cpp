#include "substances/open_space.hpp"

#include <algorithm>

namespace acinus::substances {
namespace {

/// Calls f(neighbour) for the voxels across the faces of a voxel.
template <class F>
void for_each_neighbour(const VoxelGrid& grid, std::size_t voxel, const F& f) {
  std::size_t rest = voxel, stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(grid.n[axis]);
    const std::size_t at = rest % n;
    rest /= n;
    if (at > 0) f(voxel - stride);
    if (at + 1 < n) f(voxel + stride);
    stride *= n;
  }
}

/// Closes the faces of closed voxels.
void close_faces(const VoxelGrid& grid, OpenSpace& space) {
  std::size_t v = 0;
  for (int k = 0; k < grid.n[2]; ++k)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i, ++v) {
        if (space.volume[v] > 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          space.face[axis][grid.face_index(axis, i, j, k)] = 0;
          space.face[axis]
                    [grid.face_index(axis, i + (axis == 0), j + (axis == 1), k + (axis == 2))] = 0;
        }
      }
}

/// Finds closed voxels layer by layer from the open ones.
void list_closed(const VoxelGrid& grid, OpenSpace& space) {
  const std::size_t n = space.volume.size();
  space.layer.assign(n, -1);
  space.nearest.resize(n);
  for (std::size_t v = 0; v < n; ++v) {
    space.nearest[v] = v;
    if (space.volume[v] > 0) space.layer[v] = 0;
  }
  const auto reach = [&](std::size_t from) {
    for_each_neighbour(grid, from, [&](std::size_t to) {
      if (space.layer[to] >= 0) return;
      space.layer[to] = space.layer[from] + 1;
      space.nearest[to] = space.nearest[from];
      space.closed.push_back(to);
    });
  };
  for (std::size_t v = 0; v < n; ++v)
    if (space.layer[v] == 0) reach(v);
  for (std::size_t at = 0; at < space.closed.size(); ++at) reach(space.closed[at]);
}

}  // namespace

CoveredSpace::CoveredSpace(const VoxelGrid& grid) : volume_(grid.n_voxel(), 0.0) {
  for (int axis = 0; axis < 3; ++axis) face_[axis].assign(grid.n_face(axis), 0.0);
}

void CoveredSpace::add(const Cover& cover) {
  for (const CoveredPart& p : cover.volume) volume_[p.at] += p.fraction;
  for (int axis = 0; axis < 3; ++axis)
    for (const CoveredPart& p : cover.face[axis]) face_[axis][p.at] += p.fraction;
}

OpenSpace CoveredSpace::open(const VoxelGrid& grid) const {
  OpenSpace space;
  space.volume.resize(volume_.size());
  for (std::size_t v = 0; v < volume_.size(); ++v) {
    const double open = 1 - volume_[v];
    space.volume[v] = open < kLeastOpen ? 0 : open;
  }
  for (int axis = 0; axis < 3; ++axis) {
    space.face[axis].resize(face_[axis].size());
    std::ranges::transform(face_[axis], space.face[axis].begin(),
                           [](double covered) { return std::max(0.0, 1 - covered); });
  }
  close_faces(grid, space);
  list_closed(grid, space);
  return space;
}

void carry_amounts(const OpenSpace& space, std::span<double> held) {
  for (const std::size_t v : space.closed) {
    held[space.nearest[v]] += held[v];
    held[v] = 0;
  }
}

void fill_closed(const VoxelGrid& grid, const OpenSpace& space, std::span<double> c) {
  for (const std::size_t v : space.closed) {
    double sum = 0, n = 0;
    for_each_neighbour(grid, v, [&](std::size_t from) {
      if (space.layer[from] < 0 || space.layer[from] >= space.layer[v]) return;
      sum += c[from];
      n += 1;
    });
    c[v] = sum / n;
  }
}

}  // namespace acinus::substances
