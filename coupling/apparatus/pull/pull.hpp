#pragma once
/// Forces on single cells over time: prescribed, or of a spring with a moving far end.

#include <vector>

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

/// Force on a cell, prescribed or of a spring (`stiffness` above 0). It ends with the division or
/// death of its cell.
struct Pull {
  int cell = 0;                    ///< lineage
  Vec3 direction = Vec3::UnitX();  ///< unit
  Schedule force;                  ///< nN along the direction, over s since t = 0
  double stiffness = 0;            ///< nN/um, deformable cells only
  double anchor = 0;               ///< um along the direction, initial position of the far end
  Schedule displacement;           ///< um, displacement of the far end over s since t = 0
};

/// Position of the far end of a spring, um along its direction.
inline double spring_end(const Pull& p, double time) {
  return p.anchor + (p.displacement.entry.empty() ? 0 : p.displacement.at(time));
}

/// Force along its direction on a cell with this centre, nN.
inline double pull_force(const Pull& p, double time, const Vec3& center) {
  if (p.stiffness > 0) return p.stiffness * (spring_end(p, time) - center.dot(p.direction));
  return p.force.entry.empty() ? 0 : p.force.at(time);
}

/// Pulls of a scene. Prescribed forces are forces on whole cells, springs are loads. Springs act
/// from t = 0 on; of two on one cell the later in the list acts.
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
