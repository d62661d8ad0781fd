#pragma once
/// Forces on single cells over time: prescribed, or by a spring whose far end is moved.

#include <vector>

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "coupling/apparatus/device.hpp"

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

/// Position of the far end of a spring, um along its direction.
inline double spring_end(const Pull& p, double time) {
  return p.anchor + (p.displacement.entry.empty() ? 0 : p.displacement.at(time));
}

/// Force along its direction on a cell whose centre is there, nN.
inline double pull_force(const Pull& p, double time, const Vec3& center) {
  if (p.stiffness > 0) return p.stiffness * (spring_end(p, time) - center.dot(p.direction));
  return p.force.entry.empty() ? 0 : p.force.at(time);
}

/// All pulls of a scene. Forces are added as forces on whole cells, springs as loads; springs act
/// from t = 0 on, and of two on one cell the later in the list does.
struct Pulls final : Device {
  std::vector<Pull> pull;

  bool any_spring() const;

  double next_change(double time) const override;
  void add_cell_forces(double time, const ForcedCells& cells) const override;
  void add_loads(double time, const LoadedCells& cells,
                 std::span<solve::RankOne> own) const override;
  std::size_t count_rank_one() const override { return any_spring() ? 1 : 0; }
  bool acts_at_rest() const override { return false; }
};

}  // namespace acinus::coupling
