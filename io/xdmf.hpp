#pragma once
/// XDMF sidecar of a run file, for ParaView before 5.12 and VTK before 9.3 ("XDMF Reader").

#include <span>
#include <string>

#include "io/run_layout.hpp"

namespace acinus::io {

/// Writes the sidecar in one step: a temporal collection of one spatial collection per frame, with
/// the triangles and the spheres (Polyvertex) as two grids over the same arrays of the HDF5 file;
/// empty grids are left out.
/// @param hdf5  run file, referred to by its name: both files must stay in one folder
/// Errors: Error(kFileError).
void write_xdmf(const std::string& path, const std::string& hdf5, std::span<const FrameIndex> frame,
                const RunLayout& layout);

}  // namespace acinus::io
