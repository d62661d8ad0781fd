#pragma once
/// The list of a deformable cell's own terms; a term with a zero coefficient is never entered.

#include <span>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "dcm/terms/pull_spring.hpp"
#include "dcm/terms/stretch_load.hpp"
#include "dcm/terms/suction_load.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Sizes the rank-one families that are needed (volume, area, the same of nuclei, springs that hold
/// cells; in this order); empty when none.
void size_rank_one(const State& state, std::span<const Params> params, solve::System& system,
                   bool pull_springs = false);

/// Adds all terms within cells: cortex, bending, volume, area, medium, body load, shells of nuclei.
/// @param medium_area  [n_row][lane] um^2, area of each node that touches the medium
/// @param cell_force [n_lane] nN, on the cell as a whole
void add_loads(const State& state, std::span<const Params> params, const LaneData& lanes,
               std::span<const double> medium_area, std::span<const Vec3> cell_force,
               solve::System& system);

/// Adds what an optical stretcher does to every cell.
void add_stretch_loads(const State& state, const LaneData& lanes, const StretchLoad& load,
                       solve::System& system);

/// Adds the suction of a pipette on every cell.
void add_suction_loads(const State& state, const LaneData& lanes, const SuctionLoad& load,
                       solve::System& system);

/// Adds springs that hold cells.
/// @param spring  [n_lane]
/// @pre the rank-one families were sized for them
void add_pull_spring_loads(const State& state, const LaneData& lanes,
                           std::span<const PullSpring> spring, solve::System& system);

/// Names of the terms that no type of cell uses.
std::vector<std::string> skipped_terms(std::span<const Params> params);

}  // namespace acinus::dcm
