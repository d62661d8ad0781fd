#pragma once
/// Contents of a legacy VTK file, as far as networks and surfaces need them.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/readers/input_file.hpp"

namespace acinus::geometry {

/// Test for a file that starts as legacy VTK ("# vtk DataFile").
bool is_vtk_legacy(const InputFile& file);

/// Position of an array in the file, from which that of a value follows, for error messages.
struct VtkPlace {
  std::size_t begin = 0;        ///< byte of the first value
  std::size_t value_bytes = 0;  ///< 0 for text
};

/// One attribute array of POINT_DATA or CELL_DATA.
struct VtkArray {
  std::string name;
  int components = 1;
  std::vector<double> value;  ///< [n_tuple * components]
  VtkPlace place;
};

/// List of cells: cell c is index[start[c]] .. index[start[c+1] - 1]. Not yet checked against the
/// number of points, because a polyhedron's list also holds counts.
struct VtkCells {
  std::vector<std::int64_t> start = {0};
  std::vector<std::int64_t> index;
  std::vector<std::size_t> token;  ///< [n_cell] index of the cell's first value in the file
  VtkPlace place;
  std::size_t size() const { return start.size() - 1; }
};

struct VtkLegacy {
  explicit VtkLegacy(const std::string& path) : file(path) {}
  InputFile file;
  std::string dataset;                                ///< POLYDATA or UNSTRUCTURED_GRID
  std::vector<Vec3> point;                            ///< finite, in file units
  VtkCells vertices, lines, polygons, strips, cells;  ///< cells: UNSTRUCTURED_GRID
  std::vector<std::int64_t> cell_type;                ///< [cells.size()]
  std::vector<VtkArray> point_data, cell_data;

  /// Byte position of cell c, or of the i-th value of an array.
  std::size_t position(const VtkCells& list, std::size_t c) const;
  std::size_t position(const VtkPlace& place, std::size_t i) const;
  /// Entries of one cell, each checked to be a point of this file; `what` names the cell.
  std::vector<int> nodes_of(const VtkCells& list, std::size_t c, const std::string& what) const;
};

}  // namespace acinus::geometry
