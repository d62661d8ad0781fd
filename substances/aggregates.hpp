#pragma once
/// Preconditioner of diffusion among obstacles: coarser levels are groups of voxels that conduct
/// well between each other, so that pockets behind narrow openings have unknowns of their own.

#include <array>
#include <span>
#include <vector>

#include "substances/level.hpp"

namespace acinus::substances {

/// Matrix own + sum of links on the diagonal, -link beside it.
struct LinkGraph {
  std::vector<std::size_t> start;  ///< [n + 1] into to and link
  std::vector<int> to;
  std::vector<float> link;     ///< > 0
  std::vector<float> own;      ///< [n]
  std::vector<float> inverse;  ///< [n] 1 / diagonal
  std::vector<int> parent;     ///< [n] group on the next level; empty on the last
  std::size_t n() const { return own.size(); }
};

/// W-cycle over groups, symmetric. Each level has about an eighth of the unknowns of the one
/// before. Unsmoothed aggregation of strongly linked pairs, repeated [Notay2010]; corrections are
/// enlarged by a constant factor in place of Krylov steps, so that the cycle is linear.
class Aggregates {
 public:
  /// Groups the voxels of a level with partial faces.
  void set(const Level<float>& finest, std::span<const double> own);

  /// x += correction for the residual.   @param r, x  padded, as of the finest level
  void correct(const PaddedLayout& layout, const float* r, float* x);

  /// Groups the unknowns of any graph, for apply().
  void set(LinkGraph finest);
  /// x = approximate solution for b, sweeps on the finest level included.   @param b, x  [n]
  void apply(const std::vector<float>& b, std::vector<float>& x);

 private:
  /// @param pairings  from the graph to the first level
  void build(LinkGraph graph, int pairings);
  void cycle(std::size_t at);

  LinkGraph finest_;  ///< of apply()
  std::vector<float> finest_residual_;
  std::vector<int> group_;  ///< [n_voxel, or n of finest_] of the first level; -1: closed
  std::vector<LinkGraph> level_;
  std::vector<std::vector<float>> rhs_, solution_, residual_;
};

}  // namespace acinus::substances
