#pragma once
/// A spring at the centre of a cell, along one direction: a cantilever that holds it.

#include <span>

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

struct PullSpring {
  Vec3 direction = Vec3::UnitX();  ///< unit; across it the cell is free
  double stiffness = 0;            ///< nN/um; 0: no spring
  double end = 0;                  ///< um along the direction, where the spring is at rest
};

/// Energy k/2 (d.c - end)^2 with the centre c = sum A_i x_i / sum A_i (cell_center), so that the
/// force is spread over the cell as that of add_body_load and does not deform it. It has a net
/// force, which the support of the far end balances.
/// @param spring  [kLanes]
/// @param family  its rank-one terms
void add_pull_springs(const dcm::GroupView& g, std::span<const PullSpring> spring,
                      solve::System& system, solve::RankOne& family);

}  // namespace acinus::coupling
