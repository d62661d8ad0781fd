#pragma once
/// Multigrid preconditioner of diffusion: one symmetric cycle in single precision.

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "substances/aggregates.hpp"
#include "substances/level.hpp"

namespace acinus::substances {

/// Weights of linear interpolation along an axis between a grid and the next coarser one.
struct Transfer {
  struct Parents {
    int near = 0, far = 0;  ///< coarse voxels
    double near_share = 1, far_share = 0;
  };
  std::vector<Parents> fine;  ///< per fine voxel
  /// Fine voxels with their shares, per coarse voxel.
  std::vector<std::vector<std::pair<int, double>>> coarse;
};

/// Grids from the finest to the coarsest. Every second voxel along an axis is dropped while there
/// are more than one. Among obstacles coarse voxels would join pockets that are apart: groups of
/// voxels that are connected take their place (Aggregates).
class Multigrid {
 public:
  /// Sizes all levels.
  void resize(const std::array<int, 3>& n);

  /// Sets the matrix own + diffusion on all levels; coarser ones are discretised anew.
  /// @param own          [n_voxel]
  /// @param conductance  per axis, D dt / h^2
  /// @param open         per axis across, [n_face] open fraction of faces; nullptr: all are open
  void set(std::span<const double> own, const std::array<double, 3>& conductance,
           const std::array<std::vector<double>, 3>* open = nullptr);

  /// x = cycle(b) from zero.   @param b, x  [size] of the finest level
  void apply(const float* b, float* x);

  const PaddedLayout& layout() const { return level_.front().layout; }
  std::size_t n_level() const { return level_.size(); }

 private:
  void cycle(std::size_t at, const float* b, float* x);

  std::vector<Level<float>> level_;
  Aggregates aggregates_;  ///< in place of coarser levels if the finest has obstacles
  std::vector<std::array<Transfer, 3>> transfer_;   ///< [n_level - 1]
  std::vector<std::vector<double>> own_;            ///< [n_level], unused on the finest
  std::vector<std::vector<float>> residual_;        ///< [n_level]
  std::vector<std::vector<float>> rhs_, solution_;  ///< [n_level], unused on the finest
};

}  // namespace acinus::substances
