#pragma once
/// Forces on a cell as a whole, spread over its surface: migration, random motility, a prescribed
/// pull.

#include <span>

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds F A_i / sum A on every node of every lane: area weights move the cell without distorting
/// it. [VanLiedekerke2020, Eq. (1), term 9]
/// @param cell_force [kLanes] nN
void add_body_load(const GroupView& g, std::span<const Vec3> cell_force, solve::System& system);

}  // namespace acinus::dcm
