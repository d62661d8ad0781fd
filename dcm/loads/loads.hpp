#pragma once
/// List of the terms within a deformable cell; a term with a zero coefficient is skipped.

#include <span>
#include <string>
#include <vector>

#include "core/parallel/threads.hpp"
#include "core/vec.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Sizes the rank-one families in use (volume, area, the same of nuclei, further ones; in this
/// order); empty if there are none. Their numbers have no values before solve::clear_loads.
/// @param n_further  families of loads from outside the cells
void size_rank_one(const State& state, std::span<const Params> params, solve::System& system,
                   std::size_t n_further = 0);

/// Calls add(view) for every group with loads on this process, groups in parallel where that pays.
template <class Add>
void for_each_loaded_group(const State& state, const LaneData& lanes, const solve::System& system,
                           Add add) {
  for_each_index(state.group.size(), worth_threads(state.n_row()), [&](std::size_t k) {
    if (!system.block[k].still && system.ownership.owns(k))
      add(view_group(state, lanes, system, k));
  });
}

/// Adds all terms within cells: cortex, bending, volume, area, medium, body load, shells of nuclei.
/// @param medium_area  [n_row][lane] um^2, area of each node that touches the medium
/// @param cell_force [n_lane] nN, on the cell as a whole
void add_loads(const State& state, std::span<const Params> params, const LaneData& lanes,
               std::span<const double> medium_area, std::span<const Vec3> cell_force,
               solve::System& system);

/// Names of the terms that no type of cell uses.
std::vector<std::string> skipped_terms(std::span<const Params> params);

}  // namespace acinus::dcm
