#pragma once
/// Elements of a cell mesh that terms use: the edges, and hinges and triangles only if a term uses
/// them. One pattern per topology and choice, made once.

#include "dcm/params.hpp"
#include "geometry/topology.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Pattern of a cell: elements of its cortex, then of its nucleus. Kept for the life of the
/// program, keyed by the addresses of the topologies and by the terms that are on.
const solve::BlockPattern& shared_mesh_pattern(const geometry::Topology& topology,
                                               const Params& params,
                                               const NucleusMesh& nucleus = {});

/// Pattern of points alone, for cells that do not move.
const solve::BlockPattern& shared_point_pattern(int n_point);

}  // namespace acinus::dcm
