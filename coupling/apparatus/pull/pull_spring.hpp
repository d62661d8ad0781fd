#pragma once
/// Spring between the centre of a cell and a far end along one direction: a cantilever.

#include <span>

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

struct PullSpring {
  Vec3 direction = Vec3::UnitX();  ///< unit; the cell is free across it
  double stiffness = 0;            ///< nN/um; 0: no spring
  double end = 0;                  ///< um along the direction, rest position
};

/// Adds a spring of energy k/2 (d.c - end)^2 with the centre c = sum A_i x_i / sum A_i
/// (cell_center). Its force is distributed over the cell as in add_body_load and does not deform
/// it. The net force is balanced by the support of the far end.
/// @param spring  [kLanes]
/// @param family  rank-one terms of its stiffness
void add_pull_springs(const dcm::GroupView& g, std::span<const PullSpring> spring,
                      solve::System& system, solve::RankOne& family);

}  // namespace acinus::coupling
