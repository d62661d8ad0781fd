#pragma once
/// Per-lane references of the cells at the end of a step, and the group views made of them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dcm/group_view.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Per-lane data of nuclei; all empty where no group has any.
struct NucleusLanes {
  std::vector<double> radius;  ///< [n_lane] um, reference radius of the nucleus
  std::vector<double> unit;    ///< [n_lane] 1: a nucleus has the surface of a sphere
  /// [group] lengths of links at rest over those of a sphere, [node][lane]; empty: all 1
  std::vector<std::vector<double>> link;
};

/// Per-lane data of cells for the kernels, computed once a step.
struct LaneData {
  std::vector<double> radius;  ///< [n_lane] um, reference radius at the end of the step; empty: 1
  std::vector<double> area;    ///< [n_lane] reference surface over that of a sphere
  /// [group] reference lengths and areas over those of a sphere, [element][lane]; empty: all 1
  std::vector<std::vector<double>> edge, triangle;
  /// [group] tensions of edges, nN, and the lengths of the same time, um; empty: none
  std::vector<std::vector<double>> tension, length;
  std::vector<double> active;  ///< [n_lane] 1 or 0
  NucleusLanes nucleus;
};
/// Lane data at a time, s.
LaneData make_lane_data(const State& state, double time);
/// @param ghost  [n_lane] 1: cell of another process, whose group gets no numbers per element;
///     empty: none
void refresh_lane_data(const State& state, double time, LaneData& data,
                       std::span<const std::uint8_t> ghost = {});

/// View of one group. Blocks of the deformable cells come first in the system.
GroupView view_group(const State& state, const LaneData& lanes, const solve::System& system,
                     std::size_t group);

/// View of the nuclei of a group, in the form used by the terms of a cortex. @pre the group has
/// nuclei
GroupView view_nuclei(const State& state, const LaneData& lanes, const solve::System& system,
                      std::size_t group);

}  // namespace acinus::dcm
