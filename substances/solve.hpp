#pragma once
/// Solver of one implicit step of diffusion: conjugate gradients in double precision with the
/// multigrid preconditioner.

#include <array>
#include <span>
#include <vector>

#include "substances/multigrid.hpp"

namespace acinus::substances {

/// Matrix and right-hand side of a step, divided by the volume of a voxel:
/// (own + conductance of faces) c = rhs.
struct StepSystem {
  std::array<double, 3> conductance{};  ///< per axis, D dt / h^2
  std::vector<double> own;              ///< [n_voxel] > 0; 0 in voxels whose faces are all closed
  /// Per axis across, [n_face] open fraction of faces; nullptr: all are open.
  const std::array<std::vector<double>, 3>* open = nullptr;
  std::vector<double> rhs;  ///< [n_voxel]
};

struct SolveResult {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< |rhs - A c| / |rhs|
};

/// Arrays of a step, kept for the next one.
struct StepScratch {
  StepSystem system;
  std::vector<double> before, around;  ///< [n_voxel]
};

class Solver {
 public:
  void resize(const std::array<int, 3>& n);

  /// Solves to |rhs - A c| <= tolerance |rhs|, sets what is below 0 to 0, then scales c by a factor
  /// near 1 so that the sum of the residual vanishes: what the voxels hold, gain and lose balances
  /// to round-off.
  /// @param c  [n_voxel] initial guess; written
  SolveResult solve(const StepSystem& system, double tolerance, std::span<double> c);

  StepScratch& scratch() { return scratch_; }

 private:
  /// Multiplies the start x_ by the factor of least error in energy: a field that decays or grows
  /// as a whole needs no iterations for that. Updates the residual r_; q_ has the right-hand side.
  void scale_start();

  Level<double> level_;
  Multigrid multigrid_;
  StepScratch scratch_;
  std::vector<double> x_, r_, p_, q_;
  std::vector<float> rf_, z_;
};

}  // namespace acinus::substances
