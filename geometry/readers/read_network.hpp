#pragma once
/// Readers of vessel networks.

#include <string>

#include "geometry/edit_network.hpp"
#include "geometry/network.hpp"

namespace acinus::geometry {

/// Reads legacy VTK POLYDATA with LINES (ASCII or big-endian binary, versions 1 to 5) SWC or VMV
/// (read_vmv.hpp), in file units. Nodes keep the file's order, lines of more than two points become
/// several segments. VTK radii come from an array of POINT_DATA or, when that has none, CELL_DATA,
/// as SCALARS or FIELD, called radius, radii or r, or diameter or diameters (halved), or as VMTK
/// and MicrovesselChaste call it, in any case; or the only one with "radius" in its name. Several
/// must agree. SWC radii belong to nodes; the ids are renumbered in file order.
/// @param radius_array  the name of the array, of VTK files only
/// Throws Error (Exit::kBadInput) with file, line or byte, what was found, what is allowed and what
/// to do.
Network read_network(const std::string& path, const std::string& radius_array = {});

}  // namespace acinus::geometry
