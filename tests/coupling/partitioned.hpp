#pragma once
/// Partitioned twin of the single solve: each model alone, interface forces exchanged until
/// they agree. Slower, and there to be compared with.

#include <span>

#include "solve/cg.hpp"

namespace acinus::coupling {

/// Solves A x = b by turns: the deformable cells with the spheres frozen, then the spheres with the
/// deformable cells frozen; what each sees of the other is the interface links' force. Stops when
/// the remaining imbalance is below a hundred times the tolerance, relative to the right-hand side.
/// @param n_dcm_block  blocks [0, n_dcm_block) are deformable, the rest spheres
solve::CgResult solve_partitioned(solve::Operator& op, std::span<const double> b,
                                  std::span<double> x, std::size_t n_dcm_block,
                                  const solve::CgOptions& options, solve::CgWorkspace& work);

}  // namespace acinus::coupling
