#pragma once
/// Active forces on whole cells: random motility, the directed force of leaders toward the vein,
/// constant forces, those of devices and fading forces.

#include <cstdint>

#include "coupling/world/cell_forces.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// True if cells feel a random force at present.
bool has_random_force(const World& world);

/// Mean of the unit random force over [time, time + step]. The force is constant on each interval
/// of its time grid, so any sequence of steps over the same time gives the same impulse, also after
/// rejected attempts.
Vec3 mean_random(std::uint64_t seed, std::int64_t lineage, double grid, double time, double step);

/// Computes active forces on all cells. Random force per component: Gamma_med sqrt(2 D / grid) xi,
/// with the present friction Gamma_med of the cell with the medium.
/// [VanLiedekerke2020, Eq. (1) term 9 and Eq. (19), with the noise of decision 4]
void compute_cell_forces(const World& world, const State& at, double step,
                         const MediumFriction& medium, std::span<const std::uint8_t> leader,
                         CellForces& forces);

/// Stage 4 of a step: chooses the leaders, then refreshes the friction of every cell with the
/// medium and its active force.
/// @param at  positions of all cells
/// @pre references and contacts are those of `at`
void refresh_migration(const World& world, const State& at, double step, Workspace& work);

}  // namespace acinus::coupling
