#pragma once
/// Evolution of edge tensions through a step (edge_tension.hpp).

#include <span>

#include "dcm/params.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// Length of an edge of a cell, um.
double edge_length(const State& state, std::size_t lane, std::size_t edge);

/// Starts new cells whose type has a series dashpot without tension. Must precede the motion of
/// points.
void begin_tensions(std::span<const Params> params, State& state);

/// Advances the tensions after points moved for `step`, s.   @pre begin_tensions
void advance_tensions(std::span<const Params> params, double step, State& state);

/// Mean tension of a cell's edges, nN; 0 where there is none.
double mean_tension(const EdgeTension& tension);

/// Uniform tension of all edges of a cell at their present length. @param force  nN
EdgeTension make_tension(const geometry::Topology& topology, std::span<const Vec3> node,
                         double force);

}  // namespace acinus::dcm
