#pragma once
/// In-plane tension of the cortex at the nodes.

#include <vector>

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"

namespace acinus::dcm {

/// Tension at each node, nN/um, positive = tension: sigma_i = (sqrt 3 / N_i) sum_j F_ij / l_ij over
/// the edges of node i; exact for uniform tension of a hexagonal net. The membrane's K_A (A -
/// A0)/A0 is added. [VanLiedekerke2020, Eq. (8)]
std::vector<double> compute_node_tension(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
