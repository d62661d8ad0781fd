#pragma once
/// Space that bodies leave open to a substance: fractions of voxels and of their faces.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "substances/cover.hpp"
#include "substances/grid.hpp"

namespace acinus::substances {

/// Open fraction below which a voxel is closed: it holds nothing, and nothing passes its faces.
inline constexpr double kLeastOpen = 1e-3;

struct OpenSpace {
  std::vector<double> volume;               ///< [n_voxel] open fraction; 0: closed
  std::array<std::vector<double>, 3> face;  ///< per axis across, [n_face] open fraction
  std::vector<std::size_t> nearest;         ///< [n_voxel] open voxel near by; itself where open
  std::vector<std::size_t> closed;          ///< closed voxels, those near open ones first
  std::vector<int> layer;                   ///< [n_voxel] voxels to an open one; -1: none there is
  bool exists() const { return !volume.empty(); }
};

/// Sum of covers, added in order; bodies may overlap.
class CoveredSpace {
 public:
  explicit CoveredSpace(const VoxelGrid& grid);
  void add(const Cover& cover);
  /// Space that is left.
  OpenSpace open(const VoxelGrid& grid) const;

 private:
  std::vector<double> volume_;
  std::array<std::vector<double>, 3> face_;
};

/// Amounts per voxel volume after voxels closed: what they held is in the nearest open ones.
/// @param held  [n_voxel], changed
void carry_amounts(const OpenSpace& space, std::span<double> held);

/// Sets closed voxels to the mean of their neighbours nearer to open ones, so that values and
/// gradients near bodies are those of the open space.
void fill_closed(const VoxelGrid& grid, const OpenSpace& space, std::span<double> c);

}  // namespace acinus::substances
