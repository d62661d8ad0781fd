#pragma once
/// Small fixed-size vectors. Base units everywhere inside the program: um, s, nN.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace acinus {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Cells are stored in groups of this many lanes that share one mesh topology.
inline constexpr int kLanes = 8;

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace acinus
