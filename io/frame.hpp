#pragma once
/// Content of one written frame of a run, as plain arrays that any model can fill.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace acinus::io {

/// Named array of `components` values per row. Lengths um, times s, forces nN, stresses kPa.
struct Field {
  std::string name;
  std::string unit;
  int components = 1;
  std::vector<float> value;  ///< [n_row * components]
};

/// Column of a ragged table: rows of this frame only. All columns have the same number of rows.
struct Column {
  std::string name;
  std::string unit;
  int components = 1;
  std::vector<double> value;
};
struct IdColumn {
  std::string name;
  std::vector<std::int64_t> value;
};
struct Table {
  std::vector<IdColumn> ids;
  std::vector<Column> columns;
};

/// Tables of a frame.
struct FrameTables {
  Table cells;      ///< rows of /cells: one per biological cell
  Table interface;  ///< rows of /interface: one per DCM-CBM pair in contact
  Table contacts;   ///< rows of /contacts: one per contact of cells, if asked for
};

/// Kind of a triangle or vertex of a frame; boundary: vessels, pipettes, rigid meshes.
enum FrameKind : std::uint8_t { kShell, kSphere, kBoundary, kNucleus };

/// Frame of a run. Points: mesh nodes first, then sphere centres. Cells: triangles first, then one
/// vertex per sphere.
struct Frame : FrameTables {
  double time_s = 0;
  std::vector<float> point;  ///< [(n_mesh_node + n_sphere) * 3] um
  std::int64_t n_mesh_node = 0;
  std::int64_t n_sphere = 0;
  std::vector<std::array<std::int64_t, 3>> triangle;  ///< indices into mesh nodes, this frame only
  std::vector<Field> point_data;                      ///< rows: points
  std::vector<std::int64_t> cell_id;  ///< [n_triangle + n_sphere] lineage id, -1 for boundary
  std::vector<std::uint8_t> kind;     ///< [n_triangle + n_sphere] FrameKind
  std::vector<Field> cell_data;       ///< rows: triangles, then spheres
};

/// Named scalar of a time series sample.
struct SeriesValue {
  std::string name;
  std::string unit;
  double value = 0;
};

struct Event {
  double time_s = 0;
  std::string code;                   ///< e.g. "step_rejected", "t0", "stopped"
  std::vector<std::int64_t> cell_id;  ///< cells concerned
  std::string message;
};

}  // namespace acinus::io
