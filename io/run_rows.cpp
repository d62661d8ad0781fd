#include "io/run_rows.hpp"

#include <xxhash.h>

#include <numeric>

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

template <class T>
std::uint64_t hash_of(const std::vector<T>& value, std::uint64_t seed = 0) {
  return XXH3_64bits_withSeed(value.data(), value.size() * sizeof(T), seed);
}

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

/// Writes triangles and spheres as one part, or repeats the last part when the topology is the
/// same.
void write_topology(FrameWrite& w) {
  const Frame& frame = w.frame;
  const FrameIndex* last = w.last;
  FrameIndex& index = w.index;
  w.hash.topology = hash_of(frame.triangle,
                            hash_of(std::vector<std::int64_t>{frame.n_mesh_node, frame.n_sphere}));
  if (last != nullptr && w.last_hash.known && w.hash.topology == w.last_hash.topology &&
      last->n_point == index.n_point && last->n_cell == index.n_cell &&
      last->n_connectivity == index.n_connectivity) {
    index.part = last->part;
    index.cell_offset = last->cell_offset;
    index.connectivity_offset = last->connectivity_offset;
    return;
  }
  if (last != nullptr) {
    index.part = last->part + 1;
    index.connectivity_offset =
        round_up(last->connectivity_offset + last->n_connectivity, w.filtered);
    // Readers find a part's n_cell + 1 offsets at row cell_offset + part: that sum must start a
    // chunk.
    index.cell_offset =
        round_up(last->cell_offset + last->n_cell + index.part, w.filtered) - index.part;
  }
  const auto n_triangle = std::ssize(frame.triangle);
  std::vector<std::int64_t> sphere(frame.n_sphere), offset;
  std::iota(sphere.begin(), sphere.end(), frame.n_mesh_node);
  offset.reserve(index.n_cell + 1);
  offset.push_back(0);
  for (std::int64_t c = 0; c < index.n_cell; ++c)
    offset.push_back(offset.back() + (c < n_triangle ? 3 : 1));
  std::vector<std::uint8_t> type(n_triangle, kTriangleType);
  type.resize(index.n_cell, kVertexType);
  if (n_triangle > 0)
    w.file.write_rows<std::int64_t>("/VTKHDF/Connectivity", index.connectivity_offset,
                                    std::span(frame.triangle.front().data(), 3 * n_triangle));
  if (!sphere.empty())
    w.file.write_rows<std::int64_t>("/VTKHDF/Connectivity",
                                    index.connectivity_offset + 3 * n_triangle, sphere);
  w.file.write_rows<std::int64_t>("/VTKHDF/Offsets", index.cell_offset + index.part, offset);
  w.file.write_rows<std::uint8_t>("/VTKHDF/Types", index.cell_offset, type);
  w.file.write_row<std::int64_t>("/VTKHDF/NumberOfPoints", index.part, index.n_point);
  w.file.write_row<std::int64_t>("/VTKHDF/NumberOfCells", index.part, index.n_cell);
  w.file.write_row<std::int64_t>("/VTKHDF/NumberOfConnectivityIds", index.part,
                                 index.n_connectivity);
}

template <class T>
void write_cell_array(FrameWrite& w, const std::string& name, const std::vector<T>& value) {
  const std::uint64_t now = hash_of(value);
  w.hash.cell_data[name] = now;
  std::int64_t offset = 0;
  if (w.last != nullptr) {
    offset = w.last->cell_data_offset.at(name);
    const auto known = w.last_hash.cell_data.find(name);
    if (known != w.last_hash.cell_data.end() && known->second == now &&
        w.last->n_cell == w.index.n_cell) {
      w.index.cell_data_offset[name] = offset;
      return;
    }
    offset = round_up(offset + w.last->n_cell, w.filtered);
  }
  w.file.write_rows<T>("/VTKHDF/CellData/" + name, offset, value);
  w.index.cell_data_offset[name] = offset;
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
  const Frame& frame = w.frame;
  FrameIndex& index = w.index;
  index.time_s = frame.time_s;
  index.n_point = frame.n_mesh_node + frame.n_sphere;
  index.n_cell = std::ssize(frame.triangle) + frame.n_sphere;
  index.n_connectivity = 3 * std::ssize(frame.triangle) + frame.n_sphere;
  if (w.last != nullptr)
    index.point_offset = round_up(w.last->point_offset + w.last->n_point, w.filtered);
  w.hash.known = true;
  w.file.write_rows<float>(kPoints, index.point_offset, frame.point);
  write_topology(w);
  for (const auto& field : frame.point_data) {
    w.file.write_rows<float>("/VTKHDF/PointData/" + field.name, index.point_offset, field.value);
    index.point_data_offset[field.name] = index.point_offset;
  }
  write_cell_array(w, "cell_id", frame.cell_id);
  write_cell_array(w, "kind", frame.kind);
  for (const auto& field : frame.cell_data) write_cell_array(w, field.name, field.value);
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
