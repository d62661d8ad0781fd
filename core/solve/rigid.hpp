#pragma once
/// Rigid-body correction of a linear solve, per contact-connected group of cells.
///
/// Medium friction can be 1e-8 of contact friction, so a small CG residual may hide a large rigid
/// drift of a whole cluster. Every cluster's six rigid modes are therefore solved exactly
/// (Galerkin) on the true residual. docs/decisions/0002.md says why the projected matrix is that of
/// the whole operator.

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "core/solve/operator.hpp"

namespace acinus::solve {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// What the points of a group of cells add up to, and how it moves as a rigid body.
struct RigidGroup {
  Vec3 center = Vec3::Zero();
  Vec3 sum = Vec3::Zero();  ///< um, of the positions
  double n_point = 0;
  double squared_reach = 0;  ///< um^2, farthest point from the centre
  double mass = 0;           ///< of medium friction, and its moments about the centre
  Vec3 first_moment = Vec3::Zero();
  Mat3 second_moment = Mat3::Zero();
  Vec6 residual = Vec6::Zero();
  Mat6 matrix = Mat6::Zero();
  Vec6 motion = Vec6::Zero();
  bool correct = false;

  void add(const RigidGroup& o) {
    sum += o.sum;
    n_point += o.n_point;
    squared_reach = std::max(squared_reach, o.squared_reach);
    mass += o.mass;
    first_moment += o.first_moment;
    second_moment += o.second_moment;
    residual += o.residual;
    matrix += o.matrix;
  }
};

struct RigidWorkspace {
  std::vector<int> group;  ///< [n_block * kLanes] group of each cell, -1: empty lane
  std::vector<int> block_of_row, parent;
  std::vector<RigidGroup> groups;
  std::vector<RigidGroup> part;  ///< [part of the points][group]
  std::vector<double> mode, product;
};

struct RigidResult {
  int corrected_groups = 0;
  double largest_move = 0;  ///< um, the largest rigid displacement put right
};

/// Where the cells are.
struct RigidCells {
  std::span<const double> position;      ///< [n_row][3][lane] um
  std::span<const std::uint8_t> active;  ///< [n_block * kLanes] 1 where the lane holds a cell
};

/// Corrects x (the displacement) for A x = b.
/// @param residual  [n_row][3][lane] b - A x, in double
/// @param threshold um: groups whose rigid error is provably below it are left alone
RigidResult correct_rigid_modes(const Operator& op, std::span<const double> residual,
                                std::span<double> x, const RigidCells& cells, double threshold,
                                RigidWorkspace& work);

}  // namespace acinus::solve
