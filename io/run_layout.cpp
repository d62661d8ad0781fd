#include "io/run_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>

#include "core/error.hpp"

namespace acinus::io {
namespace {

void require(bool condition, const std::string& message) {
  check(condition, "internal error while writing a frame: " + message, Exit::kInternal);
}

void check_name(const std::string& name, std::set<std::string>& seen) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
  require(plain && name != "." && name != "..",
          fmt::format("\"{}\" cannot be the name of a field", name));
  require(seen.insert(name).second, fmt::format("field \"{}\" is given twice", name));
}

template <class FieldLike>
std::vector<FieldInfo> describe(const std::vector<FieldLike>& fields, std::set<std::string> seen) {
  std::vector<FieldInfo> result;
  for (const auto& field : fields) {
    check_name(field.name, seen);
    require(!field.unit.empty(), fmt::format("field \"{}\" has no unit (use \"1\")", field.name));
    result.push_back({field.name, field.unit, field.components});
  }
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return result;
}

TableInfo describe(const Table& table) {
  std::set<std::string> seen{"frame_offset"};
  TableInfo info;
  for (const auto& id : table.ids) {
    check_name(id.name, seen);
    info.ids.push_back(id.name);
  }
  std::sort(info.ids.begin(), info.ids.end());
  info.columns = describe(table.columns, seen);
  return info;
}

template <class T>
void check_all_finite(std::span<const T> value, const std::string& what) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!std::isfinite(value[i])) {
      require(false, fmt::format("{}: value {} of {} is {}", what, i, value.size(), value[i]));
    }
  }
}

void check_triangles(std::span<const std::array<std::int64_t, 3>> triangles, std::int64_t n_node) {
  for (const auto& triangle : triangles)
    for (const std::int64_t node : triangle)
      require(node >= 0 && node < n_node,
              fmt::format("a triangle uses node {} of {}", node, n_node));
}

void check_fields(const std::vector<Field>& fields, const std::vector<std::span<const float>>& data,
                  std::int64_t n_row, const std::string& where) {
  require(data.size() == fields.size(),
          fmt::format("{} fields of {} data, not {}", data.size(), where, fields.size()));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::string name = fmt::format("{} field \"{}\"", where, fields[k].name);
    require(std::ssize(data[k]) == n_row * fields[k].components,
            fmt::format("{} has {} values, but {} rows of {} are needed", name, data[k].size(),
                        n_row, fields[k].components));
    check_all_finite(data[k], name);
  }
}

template <class FieldLike>
void check_field(const FieldLike& field, std::int64_t n_row, const std::string& where) {
  const auto size = static_cast<std::int64_t>(field.value.size());
  require(field.components >= 1,
          fmt::format("{} field \"{}\" has {} components", where, field.name, field.components));
  require(size == n_row * field.components,
          fmt::format("{} field \"{}\" has {} values, but {} rows of {} are needed", where,
                      field.name, size, n_row, field.components));
  check_all_finite(std::span(field.value), where + " field \"" + field.name + "\"");
}

void check_table(const Table& table, const std::string& where) {
  std::int64_t n_row = -1;
  for (const auto& id : table.ids) {
    const auto size = static_cast<std::int64_t>(id.value.size());
    if (n_row < 0) n_row = size;
    require(size == n_row, fmt::format("{} column \"{}\" has {} rows, others have {}", where,
                                       id.name, size, n_row));
  }
  for (const auto& column : table.columns) {
    require(column.components >= 1,
            fmt::format("{} column \"{}\" has no components", where, column.name));
    if (n_row < 0) n_row = static_cast<std::int64_t>(column.value.size()) / column.components;
    check_field(column, n_row, where);
  }
}

void check_same_fields(const std::vector<FieldInfo>& file, const std::vector<FieldInfo>& frame,
                       const std::string& where) {
  const auto text = [](const FieldInfo& f) {
    return fmt::format("{} [{}] x{}", f.name, f.unit, f.components);
  };
  for (std::size_t i = 0; i < std::max(file.size(), frame.size()); ++i) {
    if (i < file.size() && i < frame.size() && file[i] == frame[i]) continue;
    require(false, fmt::format(
                       "{} changed: the file has {}, this frame has {} (fields must stay the same)",
                       where, i < file.size() ? text(file[i]) : "nothing more",
                       i < frame.size() ? text(frame[i]) : "nothing more"));
  }
}

void check_same_table(const TableInfo& file, const TableInfo& frame, const std::string& where) {
  require(file.ids == frame.ids,
          where + " id columns changed: they must stay the same over frames");
  check_same_fields(file.columns, frame.columns, where + " columns");
}

}  // namespace

RunLayout layout_of(const FrameSource& frame) {
  RunLayout layout;
  layout.point_data = describe(frame.point_data, {});
  layout.cell_data = describe(frame.cell_data, {"cell_id", "kind"});
  for (const FrameTable& table : kFrameTables) layout.*table.info = describe(frame.*table.rows);
  return layout;
}

void check_frame(const Frame& frame) {
  const std::int64_t n_point = frame.n_mesh_node + frame.n_sphere;
  const std::int64_t n_cell = static_cast<std::int64_t>(frame.triangle.size()) + frame.n_sphere;
  check_finite(frame.time_s, "time");
  require(frame.n_mesh_node >= 0 && frame.n_sphere >= 0, "negative number of points");
  require(static_cast<std::int64_t>(frame.point.size()) == 3 * n_point,
          fmt::format("{} coordinates for {} points", frame.point.size(), n_point));
  check_all_finite(std::span(frame.point), "point coordinates");
  check_triangles(frame.triangle, frame.n_mesh_node);
  require(
      static_cast<std::int64_t>(frame.cell_id.size()) == n_cell && std::ssize(frame.kind) == n_cell,
      fmt::format("{} cell ids and {} kinds for {} triangles and spheres", frame.cell_id.size(),
                  frame.kind.size(), n_cell));
  for (const auto& field : frame.point_data) check_field(field, n_point, "point");
  for (const auto& field : frame.cell_data) check_field(field, n_cell, "cell");
}

void check_source(const FrameSource& frame) {
  check_finite(frame.time_s, "time");
  require(frame.n_mesh_node >= 0 && frame.n_sphere >= 0 && frame.n_triangle >= 0,
          "negative number of points");
  for (const FrameTable& table : kFrameTables) check_table(frame.*table.rows, table.group);
}

void check_part(const FrameSource& frame, const PointRows& rows) {
  const std::int64_t n = std::ssize(rows.point) / 3;
  require(std::ssize(rows.point) == 3 * n, "a point without three coordinates");
  check_all_finite(rows.point, "point coordinates");
  check_fields(frame.point_data, rows.data, n, "point");
}

void check_part(const FrameSource& frame, const CellRows& rows, std::int64_t first) {
  const std::int64_t n = std::ssize(rows.cell_id), n_triangle = std::ssize(rows.triangle);
  const bool fits = n_triangle > 0 ? n == n_triangle && first + n <= frame.n_triangle
                                   : n == 0 || first >= frame.n_triangle;
  require(
      fits && std::ssize(rows.kind) == n,
      fmt::format("{} cell ids and {} kinds for {} triangles", n, rows.kind.size(), n_triangle));
  check_triangles(rows.triangle, frame.n_mesh_node);
  check_fields(frame.cell_data, rows.data, n, "cell");
}

void check_row_count(std::int64_t n, std::int64_t expected, const std::string& what) {
  require(n == expected, fmt::format("{} of {} {}", n, expected, what));
}

void check_same_layout(const RunLayout& file, const RunLayout& frame) {
  check_same_fields(file.point_data, frame.point_data, "point data");
  check_same_fields(file.cell_data, frame.cell_data, "cell data");
  for (const FrameTable& table : kFrameTables)
    check_same_table(file.*table.info, frame.*table.info, table.group);
}

void check_finite(double value, const std::string& what) {
  require(std::isfinite(value), fmt::format("{} is {}", what, value));
}

}  // namespace acinus::io
