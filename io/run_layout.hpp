#pragma once
/// Layout of a run file: its fields, numbers of rows, and the first rows of each frame.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/frame_source.hpp"

namespace acinus::io {

struct FieldInfo {
  std::string name;
  std::string unit;
  int components = 1;
  bool operator==(const FieldInfo&) const = default;
};

struct TableInfo {
  std::vector<std::string> ids;    ///< sorted
  std::vector<FieldInfo> columns;  ///< sorted by name
  bool operator==(const TableInfo&) const = default;
};

/// Fields and tables of a file, the same for every frame. Lists are sorted by name.
struct RunLayout {
  std::vector<FieldInfo> point_data;
  std::vector<FieldInfo> cell_data;  ///< without cell_id and kind, which every file has
  TableInfo cells;
  TableInfo interface;
  TableInfo contacts;
  bool operator==(const RunLayout&) const = default;
};

/// Numbers of rows of a run file that belong together, e.g. at a checkpoint.
struct RunFileCounts {
  std::int64_t frame = 0;
  std::int64_t series = 0;
  std::int64_t event = 0;
  std::int64_t observable = 0;
};

/// First rows of one frame. Offsets count rows of the datasets they are named after.
struct FrameIndex {
  double time_s = 0;
  std::int64_t part = 0;  ///< row of NumberOfPoints etc.; shared by frames with the same topology
  std::int64_t n_point = 0, n_cell = 0, n_connectivity = 0;
  std::int64_t point_offset = 0, cell_offset = 0, connectivity_offset = 0;
  std::map<std::string, std::int64_t> point_data_offset;
  std::map<std::string, std::int64_t> cell_data_offset;             ///< with cell_id and kind
  std::int64_t cells_end = 0, interface_end = 0, contacts_end = 0;  ///< of this frame's table rows

  std::int64_t n_sphere() const { return n_cell - n_triangle(); }
  /// Number of triangles, from n_connectivity = 3 n_triangle + n_sphere.
  std::int64_t n_triangle() const { return (n_connectivity - n_cell) / 2; }
};

/// Table with any number of rows per frame: its group in the file and its places in memory.
struct FrameTable {
  const char* group;
  Table FrameTables::*rows;
  TableInfo RunLayout::*info;
  std::int64_t FrameIndex::*end;
};
inline constexpr std::array<FrameTable, 3> kFrameTables{
    {{"/cells", &FrameTables::cells, &RunLayout::cells, &FrameIndex::cells_end},
     {"/interface", &FrameTables::interface, &RunLayout::interface, &FrameIndex::interface_end},
     {"/contacts", &FrameTables::contacts, &RunLayout::contacts, &FrameIndex::contacts_end}}};

/// Names and units of the columns of /series or /observables, in the order of the first row.
struct RowNames {
  std::vector<std::string> name, unit;
};

/// Hashes of the last frame's topology and cell data; with equal hashes nothing is written again.
struct StaticHashes {
  bool known = false;
  std::uint64_t topology = 0;
  std::map<std::string, std::uint64_t> cell_data;
};

/// Layout of a frame. Throws Error(kInternal) on an empty or doubled name or one with characters
/// other than letters, digits, '_', '-' and '.'.
RunLayout layout_of(const FrameSource& frame);

/// Throws Error(kInternal) when sizes do not fit together, an index points nowhere, or a value is
/// not finite.
void check_frame(const Frame& frame);
/// Throws Error(kInternal) when sizes of a source or rows of its tables do not fit together, or a
/// value is not finite. Its parts are checked when they come.
void check_source(const FrameSource& frame);
void check_part(const FrameSource& frame, const PointRows& rows);
/// @param first  number of the first of these triangles or spheres
void check_part(const FrameSource& frame, const CellRows& rows, std::int64_t first);
void check_row_count(std::int64_t n, std::int64_t expected, const std::string& what);

/// Throws Error(kInternal) naming the first difference between a frame's fields and the file's.
void check_same_layout(const RunLayout& file, const RunLayout& frame);

/// Throws Error(kInternal) unless the value is finite.
void check_finite(double value, const std::string& what);

}  // namespace acinus::io
