#pragma once
/// Vessel networks as Blender's vessel tools write them.

#include "geometry/network.hpp"
#include "geometry/readers/input_file.hpp"

namespace acinus::geometry {

/// VMV text: nodes "number x y z radius" between $VERT_LIST_BEGIN and $VERT_LIST_END, strands
/// "number node node ..." between $STRANDS_LIST_BEGIN and $STRANDS_LIST_END, separated by blanks;
/// further attributes of nodes and other blocks are passed over. Throws as read_network.
Network read_vmv(InputFile& file);

}  // namespace acinus::geometry
