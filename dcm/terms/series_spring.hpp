#pragma once
/// Cortex of springs in series with dashpots: Maxwell elements along the edges.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds, for every edge, a spring k_s in series with a dashpot (series_friction), and parallel to
/// both the dashpot of the cortex (nodal_friction; with it the element is the modified Maxwell
/// element of the paper, without it a Maxwell element). The springs have no rest length: their
/// tension depends on history (edge_tension.hpp), and the force is that at the end of the step,
///   f = kept f(t) + share k_s (l - l(t)) along the edge.
/// Stiffness per edge: share k_s u u^T + max(0, f/l) (I - u u^T).
/// [VanLiedekerke2020, Eq. (5) and (6), Appendix 3]
/// @pre no edge has zero length
void add_series_springs(const Params& p, const GroupView& g, solve::System& system);

/// Energy of the springs of one lane at the start of the step, f^2 / (2 k_s), fJ.
double series_spring_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
