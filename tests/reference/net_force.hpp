#pragma once
/// Balance of forces, for tests.

#include "core/vec.hpp"

namespace acinus::reference {

/// Sums of forces and of their torques about the origin, and of the sizes they are judged by.
struct NetForce {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double force_sizes = 0, torque_sizes = 0;

  void add(const Vec3& f, const Vec3& place) {
    force += f;
    torque += place.cross(f);
    force_sizes += f.norm();
    torque_sizes += place.norm() * f.norm();
  }
  double force_share() const { return force.norm() / force_sizes; }
  double torque_share() const { return torque.norm() / torque_sizes; }
};

}  // namespace acinus::reference
