#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/page_sums.hpp"
#include "io/run_rows.hpp"

namespace acinus::io {
namespace {

using h5::File;

std::vector<FieldInfo> read_fields(const File& file, const std::string& group) {
  std::vector<FieldInfo> result;
  for (const auto& name : file.members(group)) {
    const std::string path = group + "/" + name;
    if (!file.holds<float>(path) && !file.holds<double>(path))
      continue;  // cell_id, kind, ids, frame_offset
    result.push_back(
        {name, file.read_text_attribute(path, "unit"), std::max(1, file.components(path))});
  }
  return result;
}

TableInfo read_table_info(const File& file, const std::string& group) {
  TableInfo info;
  info.columns = read_fields(file, group);
  for (const auto& name : file.members(group)) {
    if (name != "frame_offset" && file.holds<std::int64_t>(group + "/" + name))
      info.ids.push_back(name);
  }
  return info;
}

/// True if the counts and offsets of a frame are consistent. The rows themselves are checked when
/// they are read.
/// @param before  previous frame, or an empty index
bool is_possible(const FrameIndex& f, const FrameIndex& before) {
  constexpr std::int64_t kMost = std::int64_t{1} << 48;  // far from where sums overflow
  const auto in = [](std::int64_t x, std::int64_t low, std::int64_t high) {
    return x >= low && x <= high;
  };
  const auto are_rows = [&](const std::map<std::string, std::int64_t>& offsets) {
    return std::ranges::all_of(offsets, [&](const auto& o) { return in(o.second, 0, kMost); });
  };
  return in(f.n_connectivity, 0, kMost) && in(f.n_cell, 0, f.n_connectivity) &&
         (f.n_connectivity - f.n_cell) % 2 == 0 && in(f.n_sphere(), 0, f.n_point) &&
         std::isfinite(f.time_s) && in(f.n_point, 0, kMost) && in(f.point_offset, 0, kMost) &&
         in(f.cell_offset, 0, kMost) && in(f.connectivity_offset, 0, kMost) &&
         std::ranges::all_of(
             kFrameTables,
             [&](const FrameTable& t) { return in(f.*t.end, before.*t.end, kMost); }) &&
         are_rows(f.point_data_offset) && are_rows(f.cell_data_offset);
}

std::vector<std::string> table_datasets(const TableInfo& info, const std::string& where) {
  std::vector<std::string> result;
  for (const auto& id : info.ids) result.push_back(where + "/" + id);
  for (const auto& column : info.columns) result.push_back(where + "/" + column.name);
  return result;
}

}  // namespace

std::string sidecar_of(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".xmf").string();
}

void replace_run_file(const std::string& from, const std::string& to) {
  sync_file(from);
  // In between the file has no sums: readers then accept it without check.
  h5::PageSums::remove(to);
  replace_file(from, to);
  replace_file(h5::sums_of(from), h5::sums_of(to));
}

void check_run_schema(const File& file) {
  const bool known =
      file.has_attribute("/", "schema") && file.read_text_attribute("/", "schema") == "acinus/run";
  check(
      known,
      file.path() + ": is not a run file of acinus (no schema \"acinus/run\"). Give another file.",
      Exit::kFileError);
  const auto version = file.read_attribute("/", "schema_version");
  check(
      version.size() == 2 && version[0] == 1,
      fmt::format(
          "{}: was written by a newer acinus (schema version {}, this one reads 1). Update acinus.",
          file.path(), version.empty() ? 0 : version[0]),
      Exit::kFileError);
}

RunFileCounts read_counts(const File& file) {
  const bool observes = file.exists(kObservables);  // not before schema version 1.1
  const RunFileCounts counts{file.read_count("/VTKHDF/Steps", "NSteps"),
                             file.read_count(kSeries, "n_row"), file.read_count("/events", "n_row"),
                             observes ? file.read_count(kObservables, "n_row") : 0};
  // Every row has a time of eight bytes, which are not compressed.
  const auto most = static_cast<std::int64_t>(std::filesystem::file_size(file.path()) / 8);
  check(std::max({counts.frame, counts.series, counts.event, counts.observable}) <= most,
        fmt::format("{}: counts more frames, samples or events than it can hold. The file is "
                    "damaged.",
                    file.path()),
        Exit::kFileError);
  return counts;
}

RunLayout read_layout(const File& file) {
  RunLayout layout;
  layout.point_data = read_fields(file, "/VTKHDF/PointData");
  layout.cell_data = read_fields(file, "/VTKHDF/CellData");
  for (const FrameTable& table : kFrameTables)
    if (file.exists(table.group)) layout.*table.info = read_table_info(file, table.group);
  return layout;
}

std::vector<FrameIndex> read_frame_index(const File& file, const RunLayout& layout,
                                         std::int64_t n_frame) {
  const auto read = [&](const std::string& name, std::int64_t first = 0) {
    return read_column<std::int64_t>(file, name, first, n_frame);
  };
  const std::string steps = "/VTKHDF/Steps/";
  const auto time = read_column<double>(file, steps + "Values", 0, n_frame);
  std::vector<FrameIndex> frame(time.size());
  const auto part = read(steps + "PartOffsets"), point = read(steps + "PointOffsets");
  const auto cell = read(steps + "CellOffsets"),
             connectivity = read(steps + "ConnectivityIdOffsets");
  const auto n_point = file.read_all<std::int64_t>("/VTKHDF/NumberOfPoints");
  const auto n_cell = file.read_all<std::int64_t>("/VTKHDF/NumberOfCells");
  const auto n_connectivity = file.read_all<std::int64_t>("/VTKHDF/NumberOfConnectivityIds");
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const std::size_t p = part[k];
    check(part[k] >= 0 && p < n_point.size() && p < n_cell.size() && p < n_connectivity.size(),
          fmt::format("{}: frame {} refers to part {} of {}. The file is damaged.", file.path(), k,
                      part[k], n_point.size()),
          Exit::kFileError);
    FrameIndex& f = frame[k];
    f.time_s = time[k];
    f.part = part[k];
    f.n_point = n_point[p];
    f.n_cell = n_cell[p];
    f.n_connectivity = n_connectivity[p];
    f.point_offset = point[k];
    f.cell_offset = cell[k];
    f.connectivity_offset = connectivity[k];
  }
  for (const FrameTable& table : kFrameTables) {
    if (!file.exists(table.group)) continue;  // no contacts before schema version 1.2
    const auto end = read(offsets_of(table), 1);
    for (std::size_t k = 0; k < frame.size(); ++k) frame[k].*table.end = end[k];
  }
  for (const auto& field : layout.point_data) {
    const auto offset = read(steps + "PointDataOffsets/" + field.name);
    for (std::size_t k = 0; k < frame.size(); ++k)
      frame[k].point_data_offset[field.name] = offset[k];
  }
  std::vector<std::string> cell_name{"cell_id", "kind"};
  for (const auto& field : layout.cell_data) cell_name.push_back(field.name);
  for (const auto& name : cell_name) {
    const auto offset = read(steps + "CellDataOffsets/" + name);
    for (std::size_t k = 0; k < frame.size(); ++k) frame[k].cell_data_offset[name] = offset[k];
  }
  for (std::size_t k = 0; k < frame.size(); ++k)
    check(
        is_possible(frame[k], k == 0 ? FrameIndex{} : frame[k - 1]),
        fmt::format("{}: frame {} has numbers of points, cells or rows that cannot be. The file is "
                    "damaged.",
                    file.path(), k),
        Exit::kFileError);
  return frame;
}

void copy_frames(const File& from, File& to, const RunLayout& layout,
                 const std::vector<FrameIndex>& frame) {
  const auto n_frame = std::ssize(frame);
  const FrameIndex& last =
      frame.back();  // offsets never decrease: the last frame ends every dataset
  for (const char* group : {"/VTKHDF", "/VTKHDF/PointData", "/VTKHDF/CellData", "/VTKHDF/Steps",
                            "/VTKHDF/Steps/PointDataOffsets", "/VTKHDF/Steps/CellDataOffsets",
                            "/cells", "/interface", "/contacts"}) {
    to.create_group(group);
  }
  to.write_attribute("/VTKHDF", "Version", from.read_attribute("/VTKHDF", "Version"));
  to.write_attribute("/VTKHDF", "Type", from.read_text_attribute("/VTKHDF", "Type"));
  const auto copy = [&](const std::string& name, std::int64_t n) {
    to.copy_rows_from(from, name, n);
  };
  const auto copy_up_to = [&](const std::string& name, std::int64_t offset, std::int64_t n) {
    copy(name, n > 0 ? offset + n
                     : std::min(offset, from.n_row(name)));  // an empty frame wrote no padding
  };
  copy_up_to("/VTKHDF/Points", last.point_offset, last.n_point);
  copy_up_to("/VTKHDF/Connectivity", last.connectivity_offset, last.n_connectivity);
  copy_up_to("/VTKHDF/Offsets", last.cell_offset + last.part, last.n_cell + 1);
  copy_up_to("/VTKHDF/Types", last.cell_offset, last.n_cell);
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    copy(std::string("/VTKHDF/") + name, last.part + 1);
  }
  for (const char* name : {"Values", "PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets",
                           "ConnectivityIdOffsets"}) {
    copy(std::string("/VTKHDF/Steps/") + name, n_frame);
  }
  for (const auto& [name, offset] : last.point_data_offset) {
    copy_up_to("/VTKHDF/PointData/" + name, offset, last.n_point);
    copy("/VTKHDF/Steps/PointDataOffsets/" + name, n_frame);
  }
  for (const auto& [name, offset] : last.cell_data_offset) {
    copy_up_to("/VTKHDF/CellData/" + name, offset, last.n_cell);
    copy("/VTKHDF/Steps/CellDataOffsets/" + name, n_frame);
  }
  for (const FrameTable& table : kFrameTables) {
    for (const auto& name : table_datasets(layout.*table.info, table.group))
      copy(name, last.*table.end);
    copy(offsets_of(table), n_frame + 1);
  }
  to.write_attribute("/VTKHDF/Steps", "NSteps", std::span<const std::int64_t>(&n_frame, 1));
}

}  // namespace acinus::io
