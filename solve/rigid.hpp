#pragma once
/// Rigid-body correction of a linear solve, per contact-connected group of cells.
///
/// Medium friction can be 1e-8 of contact friction, so a small CG residual may hide a large rigid
/// drift of a whole cluster. Every cluster's six rigid modes are therefore solved exactly
/// (Galerkin) on the true residual. decision 2 says why the projected matrix is that of
/// the whole operator.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solve/cell_groups.hpp"
#include "solve/group_sums.hpp"
#include "solve/operator.hpp"

namespace acinus::solve {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Group of cells as a rigid body, and its motion.
struct RigidGroup {
  Vec3 center = Vec3::Zero();
  double squared_reach = 0;  ///< um^2, farthest point from the centre
  Vec6 residual = Vec6::Zero();
  Mat6 matrix = Mat6::Zero();
  Vec6 motion = Vec6::Zero();
  bool rotates =
      false;  ///< some of its unknowns are rotations, which these motions are not those of
  bool correct = false;
};

struct RigidWorkspace {
  CellGroups cells;
  std::vector<RigidGroup> groups;  ///< [group]
  GroupSums sums;
  std::vector<double> squared_reach;  ///< [group] um^2
  RowVector<int> tie_of_cell;         ///< [n_block * kLanes] of own cells: index of tie, -1: none
  std::vector<Mat6> tie;              ///< resistance of the boundary to the motion of a cell
  RowVector<double> mode;             ///< scratch; free for other use between solves
};

/// Vectors of the solve, [n_row][3][lane].
struct RigidVectors {
  std::span<const double> residual;  ///< b - A x, in double
  std::span<double> product;         ///< scratch
};

struct RigidResult {
  int corrected_groups = 0;  ///< with several processes: the largest number on one
  double largest_move = 0;   ///< um, largest rigid displacement corrected
};

/// Positions of the cells.
struct RigidCells {
  std::span<const double> position;      ///< [n_row][3][lane] um
  std::span<const std::uint8_t> active;  ///< [n_block * kLanes] 1 where the lane holds a cell
};

/// Corrects x (the displacement) for A x = b.
/// @param threshold  um, groups whose rigid error is provably below it are not corrected
RigidResult correct_rigid_modes(const Operator& op, const RigidVectors& vectors,
                                std::span<double> x, const RigidCells& cells, double threshold,
                                RigidWorkspace& work);

}  // namespace acinus::solve
