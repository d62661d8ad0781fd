#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/io/run_rows.hpp"

namespace acinus::io {
namespace {

using h5::File;

/// Names of the samples' values in order, one a line.
constexpr char kColumns[] = "columns";

}  // namespace

void check_series_names(std::span<const SeriesValue> sample) {
  std::set<std::string> seen;
  check(!sample.empty(), "internal error: an empty series sample", Exit::kInternal);
  for (const auto& value : sample) {
    const bool plain = !value.name.empty() &&
                       value.name.find_first_of("/\n") == std::string::npos && value.name != ".";
    check(plain && seen.insert(value.name).second && !value.unit.empty(),
          fmt::format("internal error: series \"{}\" [{}] has a wrong or doubled name or no unit",
                      value.name, value.unit),
          Exit::kInternal);
  }
}

void create_series_rows(File& file, std::span<const std::string> name,
                        std::span<const std::string> unit) {
  std::string columns;
  for (std::size_t i = 0; i < name.size(); ++i) {
    file.create_rows<double>("/series/" + name[i], {.chunk_rows = kIndexChunkRows}, unit[i]);
    columns += (i == 0 ? "" : "\n") + name[i];
  }
  file.write_attribute("/series", kColumns, columns);
}

void write_series(File& file, std::span<const std::string> name, std::int64_t first_row,
                  std::span<const double> value) {
  const std::size_t n_row = value.size() / name.size();
  std::vector<double> column(n_row);
  for (std::size_t i = 0; i < name.size(); ++i) {
    for (std::size_t row = 0; row < n_row; ++row) column[row] = value[row * name.size() + i];
    file.write_rows<double>("/series/" + name[i], first_row, column);
  }
}

std::vector<std::string> read_series_names(const File& file) {
  std::vector<std::string> name;
  if (!file.has_attribute("/series", kColumns)) return name;
  const std::string text = file.read_text_attribute("/series", kColumns);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    name.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return name;
}

void copy_series(const File& from, File& to, std::int64_t n_row) {
  to.create_group("/series");
  for (const auto& name : read_series_names(from))
    to.copy_rows_from(from, "/series/" + name, n_row);
  if (from.has_attribute("/series", kColumns)) {
    to.write_attribute("/series", kColumns, from.read_text_attribute("/series", kColumns));
  }
  to.write_attribute("/series", "n_row", std::span<const std::int64_t>(&n_row, 1));
}

void create_event_rows(File& file) {
  const h5::Storage small{.chunk_rows = kIndexChunkRows};
  const std::int64_t zero = 0;
  file.create_group("/events");
  file.create_rows<double>("/events/time", small, "s");
  file.create_text_rows("/events/code", kCodeWidth, kIndexChunkRows);
  file.create_text_rows("/events/message", kMessageWidth, 32);
  file.create_rows<std::int64_t>("/events/cell_id", small, "1");
  file.create_rows<std::int64_t>("/events/cell_offset", small, "1");
  file.write_row<std::int64_t>("/events/cell_offset", 0, 0);
  file.write_attribute("/events", "n_row", std::span(&zero, 1));
}

std::int64_t write_events(File& file, std::int64_t first_row, std::int64_t n_cell_written,
                          std::span<const Event> event) {
  if (event.empty()) return n_cell_written;
  std::vector<double> time;
  std::vector<std::string> code, message;
  std::vector<std::int64_t> cell_id, cell_end;
  for (const Event& e : event) {
    time.push_back(e.time_s);
    code.push_back(e.code);
    message.push_back(e.message);
    cell_id.insert(cell_id.end(), e.cell_id.begin(), e.cell_id.end());
    cell_end.push_back(n_cell_written + std::ssize(cell_id));
  }
  file.write_rows<double>("/events/time", first_row, time);
  file.write_text_rows("/events/code", first_row, code);
  file.write_text_rows("/events/message", first_row, message);
  file.write_rows<std::int64_t>("/events/cell_id", n_cell_written, cell_id);
  file.write_rows<std::int64_t>("/events/cell_offset", first_row + 1, cell_end);
  return n_cell_written + std::ssize(cell_id);
}

std::int64_t copy_events(const File& from, File& to, std::int64_t n_row) {
  const std::int64_t n_cell = from.read_rows<std::int64_t>("/events/cell_offset", n_row, 1).at(0);
  to.create_group("/events");
  for (const char* name : {"/events/time", "/events/code", "/events/message"})
    to.copy_rows_from(from, name, n_row);
  to.copy_rows_from(from, "/events/cell_id", n_cell);
  to.copy_rows_from(from, "/events/cell_offset", n_row + 1);
  to.write_attribute("/events", "n_row", std::span<const std::int64_t>(&n_row, 1));
  return n_cell;
}

}  // namespace acinus::io
