#include "io/run_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/run_rows.hpp"

namespace acinus::io {
namespace {

using h5::Access;
using h5::File;

/// Throws Error(kFileError) for numbers that are not finite: the writer never writes any, and
/// consumers sort them.
template <class T>
std::vector<T> finite(const File& file, const std::string& name, std::vector<T> value) {
  check(std::ranges::all_of(value, [](T x) { return std::isfinite(x); }),
        fmt::format("{}: dataset {} has a number that is not finite. The file is damaged.",
                    file.path(), name),
        Exit::kFileError);
  return value;
}

template <class T>
std::vector<T> read_finite(const File& file, const std::string& name, std::int64_t first,
                           std::int64_t n) {
  return finite(file, name, file.read_rows<T>(name, first, n));
}

Table read_table(const File& file, const std::string& where, const TableInfo& info,
                 std::int64_t begin, std::int64_t end) {
  Table table;
  for (const auto& id : info.ids) {
    table.ids.push_back(
        {id, read_column<std::int64_t>(file, where + "/" + id, begin, end - begin)});
  }
  for (const auto& column : info.columns) {
    table.columns.push_back(
        {column.name, column.unit, column.components,
         read_finite<double>(file, where + "/" + column.name, begin, end - begin)});
  }
  return table;
}

std::map<std::string, std::string> read_units(const std::string& path, const std::string& group) {
  const RowNames names = read_sample_names(File::open(path, Access::kRead), group);
  std::map<std::string, std::string> result;
  for (std::size_t i = 0; i < names.name.size(); ++i) result[names.name[i]] = names.unit[i];
  return result;
}

}  // namespace

RunReader::RunReader(const std::string& path) : path_(path) {
  const File file = File::open(path, Access::kRead);
  check_run_schema(file);
  counts_ = read_counts(file);
  if (counts_.frame == 0) return;
  layout_ = read_layout(file);
  frame_ = read_frame_index(file, layout_, counts_.frame);
}

const FrameIndex& RunReader::index(int k) const {
  check(k >= 0 && k < n_frame(),
        fmt::format("{}: has no frame {}, only 0 to {}", path_, k, n_frame() - 1));
  return frame_[k];
}

double RunReader::time_s(int k) const { return index(k).time_s; }

Frame RunReader::frame(int k) const {
  const FrameIndex& f = index(k);
  const File file = File::open(path_, Access::kRead);
  Frame frame;
  frame.time_s = f.time_s;
  frame.n_sphere = f.n_sphere();
  frame.n_mesh_node = f.n_point - f.n_sphere();
  frame.point = read_finite<float>(file, "/VTKHDF/Points", f.point_offset, f.n_point);
  const auto id = read_column<std::int64_t>(file, "/VTKHDF/Connectivity", f.connectivity_offset,
                                            3 * f.n_triangle());
  check(
      std::ssize(frame.point) == 3 * f.n_point &&
          std::ranges::all_of(id, [&](std::int64_t i) { return i >= 0 && i < frame.n_mesh_node; }),
      fmt::format("{}: triangles of frame {} have corners that are not there. The file is damaged.",
                  path_, k),
      Exit::kFileError);
  for (std::size_t i = 0; i + 2 < id.size(); i += 3)
    frame.triangle.push_back({id[i], id[i + 1], id[i + 2]});
  for (const auto& field : layout_.point_data) {
    frame.point_data.push_back({field.name, field.unit, field.components,
                                read_finite<float>(file, "/VTKHDF/PointData/" + field.name,
                                                   f.point_data_offset.at(field.name), f.n_point)});
  }
  const auto where = [&](const std::string& name) { return f.cell_data_offset.at(name); };
  frame.cell_id =
      read_column<std::int64_t>(file, "/VTKHDF/CellData/cell_id", where("cell_id"), f.n_cell);
  frame.kind = read_column<std::uint8_t>(file, "/VTKHDF/CellData/kind", where("kind"), f.n_cell);
  for (const auto& field : layout_.cell_data) {
    frame.cell_data.push_back(
        {field.name, field.unit, field.components,
         read_finite<float>(file, "/VTKHDF/CellData/" + field.name, where(field.name), f.n_cell)});
  }
  const FrameIndex before = k == 0 ? FrameIndex{} : index(k - 1);
  for (const FrameTable& table : kFrameTables)
    frame.*table.rows =
        read_table(file, table.group, layout_.*table.info, before.*table.end, f.*table.end);
  return frame;
}

Table RunReader::cells(int k) const {
  const FrameIndex& f = index(k);
  const File file = File::open(path_, Access::kRead);
  const std::int64_t begin = k == 0 ? 0 : index(k - 1).cells_end;
  return read_table(file, "/cells", layout_.cells, begin, f.cells_end);
}

std::map<std::string, std::vector<double>> RunReader::series() const {
  return read_samples(File::open(path_, Access::kRead), kSeries, counts_.series);
}

std::map<std::string, std::vector<double>> RunReader::observables() const {
  return read_samples(File::open(path_, Access::kRead), kObservables, counts_.observable);
}

std::map<std::string, std::string> RunReader::observable_unit() const {
  return read_units(path_, kObservables);
}

std::vector<Event> RunReader::events() const {
  return read_events(File::open(path_, Access::kRead), 0, counts_.event);
}

std::map<std::string, std::string> RunReader::provenance() const {
  const File file = File::open(path_, Access::kRead);
  std::map<std::string, std::string> result;
  for (const auto& key : file.members("/provenance"))
    result[key] = file.read_text("/provenance/" + key);
  return result;
}

}  // namespace acinus::io
