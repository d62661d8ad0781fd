#pragma once
/// Elements that the terms of a cell mesh need: the edges, and the hinges and triangles only where
/// a term uses them. One per topology and choice, made once.

#include "dcm/params.hpp"
#include "geometry/topology.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// The elements of a cell of this kind, those of its nucleus after those of its cortex. Kept for
/// the life of the program, keyed by the addresses of the topologies and by which terms are on.
const solve::BlockPattern& shared_mesh_pattern(const geometry::Topology& topology,
                                               const Params& params,
                                               const NucleusMesh& nucleus = {});

/// Points alone, for cells that do not move.
const solve::BlockPattern& shared_point_pattern(int n_point);

}  // namespace acinus::dcm
