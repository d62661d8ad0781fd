#pragma once
/// Solution of an implicit step of a substance inside and outside bodies.

#include <span>

#include "substances/grid.hpp"
#include "substances/parts.hpp"
#include "substances/solve.hpp"

namespace acinus::substances {

/// Passage through membranes during a step.
struct MembraneStep {
  double permeability = 0;  ///< um/s
  double diffusion = 0;     ///< um^2/s
  double step = 0;          ///< s
};

/// Solves for the concentrations of voxels and parts, as Solver::solve.
/// @param system  own and rhs [n_voxel, then parts]; conductances and open faces of voxels
/// @param c       [n_voxel, then parts] initial guess; written, but in closed voxels without a
///                membrane
SolveResult solve_parts(const VoxelGrid& grid, const Parts& parts, const MembraneStep& how,
                        const StepSystem& system, double tolerance, std::span<double> c);

}  // namespace acinus::substances
