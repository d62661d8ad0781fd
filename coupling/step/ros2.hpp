#pragma once
/// ROS2: two stages with one matrix, Gamma/(g h) + K, g = 1 - 1/sqrt 2, order 2 for any K
/// [Verwer1999, Eq. (1.3)].

#include "coupling/step/attempt.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

Attempt try_ros2(const World& world, double step, Workspace& work);

}  // namespace acinus::coupling
