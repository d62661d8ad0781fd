#include "io/run_rows.hpp"

#include <xxhash.h>

#include <array>
#include <memory>
#include <optional>

namespace acinus::io {
namespace {

using h5::File;
using h5::Storage;

constexpr char kPoints[] = "/VTKHDF/Points";
constexpr std::uint8_t kVertexType = 1, kTriangleType = 5;
constexpr int kOneColumn = 1;  // Steps/CellOffsets and ConnectivityIdOffsets are [n][1]

std::int64_t round_up(std::int64_t row, bool filtered) {
  return filtered ? (row + kChunkRows - 1) / kChunkRows * kChunkRows : row;
}

/// Components of a dataset in HDF5: VTKHDF wants scalars one-dimensional.
int stored_components(int components) { return components == 1 ? 0 : components; }

/// Hash of values that come in parts.
class RowHash {
 public:
  explicit RowHash(std::span<const std::int64_t> first = {}) : state_(XXH3_createState()) {
    XXH3_64bits_reset(state_.get());
    put(first);
  }
  template <class T>
  void put(std::span<const T> values) {
    XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
  }
  std::uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  struct FreeHash {
    void operator()(XXH3_state_t* s) const { XXH3_freeState(s); }
  };
  std::unique_ptr<XXH3_state_t, FreeHash> state_;
};

template <class T>
void write_index_value(File& file, const std::string& name, std::int64_t row, const T& value) {
  file.write_row<T>("/VTKHDF/Steps/" + name, row, value);
}

void create_table_rows(File& file, const std::string& where, const TableInfo& info) {
  for (const auto& id : info.ids) {
    file.create_rows<std::int64_t>(where + "/" + id, {.chunk_rows = kTableChunkRows}, "1");
  }
  for (const auto& column : info.columns) {
    const Storage storage{.components = stored_components(column.components),
                          .chunk_rows = kTableChunkRows};
    file.create_rows<double>(where + "/" + column.name, storage, column.unit);
  }
}

/// Writes a table; returns the end of its rows.
std::int64_t write_table(File& file, const std::string& where, const Table& table,
                         std::int64_t first_row) {
  std::int64_t n_row = 0;
  for (const auto& id : table.ids) {
    file.write_rows<std::int64_t>(where + "/" + id.name, first_row, id.value);
    n_row = std::ssize(id.value);
  }
  for (const auto& column : table.columns) {
    file.write_rows<double>(where + "/" + column.name, first_row, column.value);
    n_row = std::ssize(column.value) / column.components;
  }
  return first_row + n_row;
}

/// Hashes topology and cell data, and checks their parts.
StaticHashes hash_surfaces(const FrameSource& frame) {
  const std::array<std::int64_t, 2> sizes{frame.n_mesh_node, frame.n_sphere};
  RowHash topology(sizes), id, kind;
  std::vector<RowHash> field(frame.cell_data.size());
  std::int64_t n = 0;
  frame.surfaces([&](const CellRows& rows) {
    check_part(frame, rows, n);
    n += std::ssize(rows.cell_id);
    topology.put(rows.triangle);
    id.put(rows.cell_id);
    kind.put(rows.kind);
    for (std::size_t k = 0; k < field.size(); ++k) field[k].put(rows.data[k]);
  });
  check_row_count(n, frame.n_cell(), "triangles and spheres");
  StaticHashes hash{true, topology.value(), {{"cell_id", id.value()}, {"kind", kind.value()}}};
  for (std::size_t k = 0; k < field.size(); ++k)
    hash.cell_data[frame.cell_data[k].name] = field[k].value();
  return hash;
}

/// Places triangles and spheres as one part, or repeats the last part when the topology is the
/// same.
/// @return true if they must be written
bool place_topology(FrameWrite& w) {
  const FrameIndex* last = w.last;
  FrameIndex& index = w.index;
  if (last == nullptr) return true;
  if (w.last_hash.known && w.hash.topology == w.last_hash.topology &&
      last->n_point == index.n_point && last->n_cell == index.n_cell &&
      last->n_connectivity == index.n_connectivity) {
    index.part = last->part;
    index.cell_offset = last->cell_offset;
    index.connectivity_offset = last->connectivity_offset;
    return false;
  }
  index.part = last->part + 1;
  index.connectivity_offset =
      round_up(last->connectivity_offset + last->n_connectivity, w.filtered);
  // Readers find a part's n_cell + 1 offsets at row cell_offset + part: that sum must start a
  // chunk.
  index.cell_offset =
      round_up(last->cell_offset + last->n_cell + index.part, w.filtered) - index.part;
  return true;
}

/// Places an array of cell data.   @return true if it must be written
bool place_cell_array(FrameWrite& w, const std::string& name) {
  std::int64_t& offset = w.index.cell_data_offset[name];
  if (w.last == nullptr) return true;
  offset = w.last->cell_data_offset.at(name);
  const auto known = w.last_hash.cell_data.find(name);
  if (known != w.last_hash.cell_data.end() && known->second == w.hash.cell_data.at(name) &&
      w.last->n_cell == w.index.n_cell)
    return false;
  offset = round_up(offset + w.last->n_cell, w.filtered);
  return true;
}

/// Writes what does not depend on positions: ends of the cells, their types and sizes.
void write_cell_types(FrameWrite& w) {
  const FrameIndex& index = w.index;
  RowWriter<std::int64_t> offsets(w.file, "/VTKHDF/Offsets", index.cell_offset + index.part);
  RowWriter<std::uint8_t> types(w.file, "/VTKHDF/Types", index.cell_offset);
  std::int64_t end = 0;
  offsets.put(end);
  for (std::int64_t c = 0; c < index.n_cell; ++c) {
    const bool triangle = c < w.frame.n_triangle;
    offsets.put(end += triangle ? 3 : 1);
    types.put(triangle ? kTriangleType : kVertexType);
  }
  offsets.finish();
  types.finish();
  w.file.write_row<std::int64_t>("/VTKHDF/NumberOfPoints", index.part, index.n_point);
  w.file.write_row<std::int64_t>("/VTKHDF/NumberOfCells", index.part, index.n_cell);
  w.file.write_row<std::int64_t>("/VTKHDF/NumberOfConnectivityIds", index.part,
                                 index.n_connectivity);
}

/// Writer of an array of cell data, if it has changed.
template <class T>
std::optional<RowWriter<T>> cell_writer(FrameWrite& w, const std::string& name,
                                        int components = 1) {
  if (!place_cell_array(w, name)) return std::nullopt;
  return RowWriter<T>(w.file, "/VTKHDF/CellData/" + name, w.index.cell_data_offset.at(name),
                      components);
}

void write_surfaces(FrameWrite& w) {
  const bool topology = place_topology(w);
  RowWriter<std::int64_t> corners(w.file, "/VTKHDF/Connectivity", w.index.connectivity_offset);
  auto id = cell_writer<std::int64_t>(w, "cell_id");
  auto kind = cell_writer<std::uint8_t>(w, "kind");
  std::vector<std::optional<RowWriter<float>>> field;
  bool any = topology || id || kind;
  for (const Field& f : w.frame.cell_data) {
    field.push_back(cell_writer<float>(w, f.name, f.components));
    any = any || field.back();
  }
  if (!any) return;
  std::int64_t sphere = w.frame.n_mesh_node;  // the point of the next one
  w.frame.surfaces([&](const CellRows& rows) {
    if (topology) {
      for (const auto& t : rows.triangle) corners.put(std::span<const std::int64_t>(t));
      if (rows.triangle.empty())
        for (std::size_t k = 0; k < rows.cell_id.size(); ++k) corners.put(sphere++);
    }
    if (id) id->put(rows.cell_id);
    if (kind) kind->put(rows.kind);
    for (std::size_t k = 0; k < field.size(); ++k)
      if (field[k]) field[k]->put(rows.data[k]);
  });
  corners.finish();
  if (id) id->finish();
  if (kind) kind->finish();
  for (auto& f : field)
    if (f) f->finish();
  if (topology) write_cell_types(w);
}

void write_points(FrameWrite& w) {
  const FrameSource& frame = w.frame;
  RowWriter<float> point(w.file, kPoints, w.index.point_offset, 3);
  std::vector<RowWriter<float>> field;
  for (const Field& f : frame.point_data) {
    field.emplace_back(w.file, "/VTKHDF/PointData/" + f.name, w.index.point_offset, f.components);
    w.index.point_data_offset[f.name] = w.index.point_offset;
  }
  std::int64_t n = 0;
  frame.points([&](const PointRows& rows) {
    check_part(frame, rows);
    n += std::ssize(rows.point) / 3;
    point.put(rows.point);
    for (std::size_t k = 0; k < field.size(); ++k) field[k].put(rows.data[k]);
  });
  check_row_count(n, frame.n_point(), "points");
  point.finish();
  for (RowWriter<float>& f : field) f.finish();
}

}  // namespace

void create_index_rows(File& file, bool filtered) {
  const Storage big{.chunk_rows = kChunkRows, .filtered = filtered};
  const Storage small{.chunk_rows = kIndexChunkRows};
  const Storage column{.components = kOneColumn, .chunk_rows = kIndexChunkRows};
  for (const char* group : {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData", "/VTKHDF/Steps",
                            "/VTKHDF/Steps/PointDataOffsets", "/VTKHDF/Steps/CellDataOffsets",
                            "/cells", "/interface", "/contacts"}) {
    file.create_group(group);
  }
  const std::int64_t version[2] = {2, 0};
  const std::int64_t zero = 0;
  file.write_attribute("/VTKHDF", "Version", version);
  file.write_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  file.write_attribute("/VTKHDF/Steps", "NSteps", std::span(&zero, 1));
  file.create_rows<float>(kPoints,
                          {.components = 3, .chunk_rows = kChunkRows, .filtered = filtered}, "um");
  file.create_rows<std::int64_t>("/VTKHDF/Connectivity", big, "1");
  file.create_rows<std::int64_t>("/VTKHDF/Offsets", big, "1");
  file.create_rows<std::uint8_t>("/VTKHDF/Types", {.chunk_rows = kChunkRows}, "1");
  file.create_rows<std::int64_t>("/VTKHDF/CellData/cell_id", big, "1");
  file.create_rows<std::uint8_t>("/VTKHDF/CellData/kind", big, "1");
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    file.create_rows<std::int64_t>(std::string("/VTKHDF/") + name, small, "1");
  }
  file.create_rows<double>("/VTKHDF/Steps/Values", small, "s");
  for (const char* name : {"PartOffsets", "NumberOfParts", "PointOffsets",
                           "CellDataOffsets/cell_id", "CellDataOffsets/kind"}) {
    file.create_rows<std::int64_t>(std::string("/VTKHDF/Steps/") + name, small, "1");
  }
  for (const char* name : {"CellOffsets", "ConnectivityIdOffsets"}) {
    file.create_rows<std::int64_t>(std::string("/VTKHDF/Steps/") + name, column, "1");
  }
  for (const FrameTable& table : kFrameTables) {
    file.create_rows<std::int64_t>(offsets_of(table), small, "1");
    file.write_row<std::int64_t>(offsets_of(table), 0, 0);
  }
}

void create_field_rows(File& file, const RunLayout& layout, bool filtered) {
  const Storage index{.chunk_rows = kIndexChunkRows};
  const auto create = [&](const FieldInfo& field, const std::string& where) {
    file.create_rows<float>("/VTKHDF/" + where + "/" + field.name,
                            {.components = stored_components(field.components),
                             .chunk_rows = kChunkRows,
                             .filtered = filtered},
                            field.unit);
    file.create_rows<std::int64_t>("/VTKHDF/Steps/" + where + "Offsets/" + field.name, index, "1");
  };
  for (const auto& field : layout.point_data) create(field, "PointData");
  for (const auto& field : layout.cell_data) create(field, "CellData");
  for (const FrameTable& table : kFrameTables)
    create_table_rows(file, table.group, layout.*table.info);
}

void write_frame(FrameWrite& w) {
  const FrameSource& frame = w.frame;
  FrameIndex& index = w.index;
  index.time_s = frame.time_s;
  index.n_point = frame.n_point();
  index.n_cell = frame.n_cell();
  index.n_connectivity = 3 * frame.n_triangle + frame.n_sphere;
  if (w.last != nullptr)
    index.point_offset = round_up(w.last->point_offset + w.last->n_point, w.filtered);
  write_points(w);
  w.hash = hash_surfaces(frame);
  write_surfaces(w);
  const FrameIndex none;
  const FrameIndex& before = w.last == nullptr ? none : *w.last;
  for (const FrameTable& table : kFrameTables)
    index.*table.end = write_table(w.file, table.group, frame.*table.rows, before.*table.end);
}

void write_index(File& file, std::int64_t k, const FrameIndex& index) {
  write_index_value<double>(file, "Values", k, index.time_s);
  write_index_value<std::int64_t>(file, "PartOffsets", k, index.part);
  write_index_value<std::int64_t>(file, "NumberOfParts", k, 1);
  write_index_value<std::int64_t>(file, "PointOffsets", k, index.point_offset);
  write_index_value<std::int64_t>(file, "CellOffsets", k, index.cell_offset);
  write_index_value<std::int64_t>(file, "ConnectivityIdOffsets", k, index.connectivity_offset);
  for (const auto& [name, offset] : index.point_data_offset) {
    write_index_value<std::int64_t>(file, "PointDataOffsets/" + name, k, offset);
  }
  for (const auto& [name, offset] : index.cell_data_offset) {
    write_index_value<std::int64_t>(file, "CellDataOffsets/" + name, k, offset);
  }
  for (const FrameTable& table : kFrameTables)
    file.write_row<std::int64_t>(offsets_of(table), k + 1, index.*table.end);
}

void write_counts(File& file, const RunFileCounts& counts) {
  file.write_attribute(kSeries, "n_row", std::span(&counts.series, 1));
  file.write_attribute("/events", "n_row", std::span(&counts.event, 1));
  file.write_attribute(kObservables, "n_row", std::span(&counts.observable, 1));
  file.write_attribute("/VTKHDF/Steps", "NSteps", std::span(&counts.frame, 1));
}

}  // namespace acinus::io
