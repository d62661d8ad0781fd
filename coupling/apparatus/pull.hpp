#pragma once
/// Forces on single cells over time: prescribed, or by a spring whose far end is moved.

#include <vector>

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "dcm/state.hpp"
#include "dcm/terms/pull_spring.hpp"

namespace acinus::coupling {

/// One of the two acts: the force, or a spring if `stiffness` is above 0. It ends when its cell
/// divides or dies.
struct Pull {
  int cell = 0;                    ///< lineage
  Vec3 direction = Vec3::UnitX();  ///< unit
  Schedule force;                  ///< nN along the direction, over s since t = 0
  double stiffness = 0;            ///< nN/um, deformable cells only
  double anchor = 0;               ///< um along the direction, the far end before it moves
  Schedule displacement;           ///< um by which it has moved, over s since t = 0
};

/// Where the far end of a spring is, um along its direction.
inline double spring_end(const Pull& p, double time) {
  return p.anchor + (p.displacement.entry.empty() ? 0 : p.displacement.at(time));
}

/// Force along its direction on a cell whose centre is there, nN.
inline double pull_force(const Pull& p, double time, const Vec3& center) {
  if (p.stiffness > 0) return p.stiffness * (spring_end(p, time) - center.dot(p.direction));
  return p.force.entry.empty() ? 0 : p.force.at(time);
}

/// Whether any of them is a spring.
bool any_spring(const std::vector<Pull>& pulls);

/// The springs of all deformable cells; without stiffness where there is none.
/// @param[out] spring  [n_lane]
void find_springs(const std::vector<Pull>& pulls, double time, const dcm::State& cells,
                  std::vector<dcm::PullSpring>& spring);

/// The next time after `time` at which a force or a displacement bends, s; infinite if none does.
double next_bend(const std::vector<Pull>& pulls, double time);

}  // namespace acinus::coupling
