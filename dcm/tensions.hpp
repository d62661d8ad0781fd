#pragma once
/// How the tensions of edges go through a step (edge_tension.hpp).

#include <span>

#include "dcm/params.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// Length of an edge of a cell, um.
double edge_length(const State& state, std::size_t lane, std::size_t edge);

/// Lets new cells whose type has a series dashpot begin without tension. To be called before the
/// points move.
void begin_tensions(std::span<const Params> params, State& state);

/// The tensions after points moved for `step`, s.   @pre begin_tensions
void advance_tensions(std::span<const Params> params, double step, State& state);

/// Mean tension of a cell's edges, nN; 0 where there is none.
double mean_tension(const EdgeTension& tension);

/// All edges of a cell under the same tension at their present length.
EdgeTension make_tension(const geometry::Topology& topology, std::span<const Vec3> node,
                         double force);

}  // namespace acinus::dcm
