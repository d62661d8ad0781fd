#pragma once
/// Cells of one frame of a run, read from its run file.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "io/run_reader.hpp"

namespace acinus::runs {

/// Figures of one cell in a frame.
struct CellRecord {
  Vec3 center = Vec3::Zero();  ///< centroid, um
  double pressure = 0;         ///< contact pressure, Pa
  double force = 0;            ///< sum of the magnitudes of its contact forces, nN
  double contacts = 0;         ///< number of touching cells
  bool deformable = false;
  double radius = 0;  ///< radius of its reference volume, um
};

/// Column of a frame's cell table by name.
/// @throws Error if the column is missing, as in files of older versions
const std::vector<double>& cell_column(const io::Table& cells, const std::string& name,
                                       const std::string& folder);

using CellRecords = std::map<std::int64_t, CellRecord>;  ///< keyed by lineage

/// Reads the cells of a frame.
/// @param folder  run folder, for messages
/// @throws Error if a column is missing, as in files of older versions
CellRecords read_cells(const io::RunReader& reader, int frame, const std::string& folder);

}  // namespace acinus::runs
