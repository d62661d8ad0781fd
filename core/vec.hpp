#pragma once
/// Small fixed-size vectors. Base units everywhere inside the program: um, s, nN.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace acinus {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Number of cells in a group: cells that share one mesh topology are stored side by side in lanes.
inline constexpr int kLanes = 8;

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace acinus
