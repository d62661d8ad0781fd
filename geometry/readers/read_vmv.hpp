#pragma once
/// Reader of vessel networks in the VMV format of Blender's vessel tools.

#include "geometry/network.hpp"
#include "geometry/readers/input_file.hpp"

namespace acinus::geometry {

/// Reads VMV text: nodes "number x y z radius" between $VERT_LIST_BEGIN and $VERT_LIST_END, strands
/// "number node node ..." between $STRANDS_LIST_BEGIN and $STRANDS_LIST_END, separated by blanks;
/// further attributes of nodes and other blocks are skipped. Throws as read_network.
Network read_vmv(InputFile& file);

}  // namespace acinus::geometry
