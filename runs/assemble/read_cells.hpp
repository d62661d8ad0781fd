#pragma once
/// The cells of one frame of a run, read back from its file.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "io/run_reader.hpp"

namespace acinus::runs {

struct CellRecord {
  Vec3 center = Vec3::Zero();  ///< um
  double pressure = 0;         ///< Pa, contact pressure
  double force = 0;            ///< nN, sum of the sizes of its contact forces
  double contacts = 0;         ///< cells it touches
  bool deformable = false;
  double radius = 0;  ///< um, of its reference volume
};

/// A column of a frame's cells by its name.
/// @throws Error where an older version of the program, that had none, wrote the file
const std::vector<double>& cell_column(const io::Table& cells, const std::string& name,
                                       const std::string& folder);

using CellRecords = std::map<std::int64_t, CellRecord>;  ///< by lineage

/// @param folder  of the run, for messages
/// @throws Error where an older version of the program wrote the file
CellRecords read_cells(const io::RunReader& reader, int frame, const std::string& folder);

}  // namespace acinus::runs
