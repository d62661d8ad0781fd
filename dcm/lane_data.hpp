#pragma once
/// Per-lane references of the cells at the end of a step, and the view of a group made of them.

#include <cstddef>
#include <vector>

#include "dcm/group_view.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Per-lane numbers of nuclei; all empty where no group has any.
struct NucleusLanes {
  std::vector<double> radius;  ///< [n_lane] um, reference radius of the nucleus
  std::vector<double> unit;    ///< [n_lane] 1: a nucleus has the surface of a sphere
  /// [group] lengths of links at rest over those of a sphere, [node][lane]; empty: all 1
  std::vector<std::vector<double>> link;
};

/// Per-lane numbers of cells that the kernels need, made once a step.
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

/// The view of the nuclei of a group, as the terms of a cortex see it. @pre the group has nuclei
GroupView view_nuclei(const State& state, const LaneData& lanes, const solve::System& system,
                      std::size_t group);

}  // namespace acinus::dcm
