#pragma once
/// The list of a deformable cell's own terms; a term with a zero coefficient is never entered.

#include <span>
#include <string>
#include <vector>

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "dcm/terms/pull_spring.hpp"
#include "dcm/terms/stretch_load.hpp"
#include "dcm/terms/suction_load.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// What they need of nuclei; all empty where no group has any.
struct NucleusLanes {
  std::vector<double> radius;  ///< [n_lane] um, reference radius of the nucleus
  std::vector<double> unit;    ///< [n_lane] 1: a nucleus has the surface of a sphere
  /// [group] lengths of links at rest over those of a sphere, [node][lane]; empty: all 1
  std::vector<std::vector<double>> link;
};

/// Per-lane numbers the kernels need, made once a step.
struct LaneData {
  std::vector<double> radius;  ///< [n_lane] um, reference radius at the end of the step; empty: 1
  std::vector<double> area;    ///< [n_lane] reference surface over that of a sphere
  /// [group] reference lengths and areas over those of a sphere, [element][lane]; empty: all 1
  std::vector<std::vector<double>> edge, triangle;
  /// [group] tensions of edges, nN, and their lengths when that was, um; empty: none
  std::vector<std::vector<double>> tension, length;
  std::vector<double> active;  ///< [n_lane] 1 or 0
  NucleusLanes nucleus;
};
LaneData make_lane_data(const State& state, double time);
void find_lane_data(const State& state, double time, LaneData& data);

/// The view of one group. Blocks of the deformable cells come first in the system.
GroupView view_group(const State& state, const LaneData& lanes, const solve::System& system,
                     std::size_t group);

/// That of their nuclei, as the terms of a cortex see it. @pre the group has nuclei
GroupView view_nuclei(const State& state, const LaneData& lanes, const solve::System& system,
                      std::size_t group);

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
