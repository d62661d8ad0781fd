#pragma once
/// Whether a computed displacement may become State: finite, small enough, no face turned over, no
/// contact driven deep; and how well forces balance.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/workspace.hpp"
#include "coupling/world.hpp"

namespace acinus::coupling {

struct Verdict {
  bool good = true;
  std::string cause;
  std::vector<std::int64_t> cells;
  double error = 0;     ///< um
  double max_move = 0;  ///< um
};

/// Largest displacement a cell may make in one step, um: max_move mean edges of its mesh; spheres
/// as a 162-node mesh of their radius. Infinite when max_move is 0.
double move_limit(double max_move, double mean_edge);
inline constexpr double kSphereEdge = 0.3;  ///< mean edge of a 162-node mesh, in radii

Verdict judge_step(const World& world, double step, Workspace& work);

/// Size of an error field, um: the larger of the rms and a fifth of the maximum over nodes. With
/// random motility every cell's mean is left out: it is white noise, which is integrated exactly.
/// @param field [n_row][3][lane] um
double error_norm(const World& world, const Workspace& work, std::span<const double> field);

/// Error estimate, um: half the change of velocity times the step. A first step is compared with
/// rest.
double estimate_error(const World& world, double step, Workspace& work);

/// Force balance of the step just solved.   @pre work.rhs, work.move, work.cg.residual
Balance measure_balance(const World& world, Workspace& work);

}  // namespace acinus::coupling
