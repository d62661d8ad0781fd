#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "io/run_rows.hpp"

namespace acinus::io {
namespace {

using h5::File;

/// Dataset with the names of the sample columns in order, one a line.
constexpr char kColumns[] = "columns";

}  // namespace

RowNames names_of(std::span<const SeriesValue> sample, const std::string& group) {
  RowNames names;
  std::set<std::string> seen;
  check(!sample.empty(), "internal error: an empty sample of " + group, Exit::kInternal);
  for (const auto& value : sample) {
    const bool plain = !value.name.empty() &&
                       value.name.find_first_of("/\n") == std::string::npos && value.name != ".";
    check(plain && seen.insert(value.name).second && !value.unit.empty(),
          fmt::format("internal error: {} \"{}\" [{}] has a wrong or doubled name or no unit",
                      group, value.name, value.unit),
          Exit::kInternal);
    names.name.push_back(value.name);
    names.unit.push_back(value.unit);
  }
  return names;
}

void check_sample(std::span<const SeriesValue> sample, const RowNames& names,
                  const std::string& group) {
  for (const SeriesValue& value : sample)
    check_finite(value.value, group + " \"" + value.name + "\"");
  std::size_t same = 0;
  while (same < sample.size() && same < names.name.size() &&
         sample[same].name == names.name[same] && sample[same].unit == names.unit[same])
    ++same;
  if (same == sample.size() && same == names.name.size()) return;
  const auto quoted = [same](std::size_t n, auto name_of) {
    return same < n ? "\"" + name_of(same) + "\"" : std::string("no more");
  };
  throw Error(
      fmt::format("{}: the file has {} where this program records {}: the run was begun by "
                  "another version. Continue it with that version, or run the scene anew "
                  "in another folder (--out)",
                  group, quoted(names.name.size(), [&](std::size_t k) { return names.name[k]; }),
                  quoted(sample.size(), [&](std::size_t k) { return sample[k].name; })),
      Exit::kCannotContinue);
}

void create_samples(File& file, const std::string& group) {
  file.create_group(group);
  file.write_attribute(group, "n_row", std::span<const std::int64_t>({std::int64_t{0}}));
}

void create_sample_rows(File& file, const std::string& group, const RowNames& names) {
  std::string columns;
  for (std::size_t i = 0; i < names.name.size(); ++i) {
    file.create_rows<double>(group + "/" + names.name[i], {.chunk_rows = kIndexChunkRows},
                             names.unit[i]);
    columns += (i == 0 ? "" : "\n") + names.name[i];
  }
  file.write_attribute(group, kColumns, columns);
}

void write_samples(File& file, const std::string& group, const RowNames& names,
                   std::int64_t first_row, std::span<const double> value) {
  const std::size_t n_column = names.name.size(), n_row = value.size() / n_column;
  std::vector<double> column(n_row);
  for (std::size_t i = 0; i < n_column; ++i) {
    for (std::size_t row = 0; row < n_row; ++row) column[row] = value[row * n_column + i];
    file.write_rows<double>(group + "/" + names.name[i], first_row, column);
  }
}

RowNames read_sample_names(const File& file, const std::string& group) {
  RowNames names;
  if (!file.exists(group) || !file.has_attribute(group, kColumns)) return names;
  const std::string text = file.read_text_attribute(group, kColumns);
  std::set<std::string> seen;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    names.name.push_back(text.substr(begin, end - begin));
    check(!names.name.back().empty() && seen.insert(names.name.back()).second,
          fmt::format("{}: the columns of {} have no name, or one twice. The file is damaged.",
                      file.path(), group),
          Exit::kFileError);
    names.unit.push_back(file.read_text_attribute(group + "/" + names.name.back(), "unit"));
    begin = end + 1;
  }
  return names;
}

std::map<std::string, std::vector<double>> read_samples(const File& file, const std::string& group,
                                                        std::int64_t n_row) {
  std::map<std::string, std::vector<double>> result;
  for (const auto& name : read_sample_names(file, group).name)
    result[name] = read_column<double>(file, group + "/" + name, 0, n_row);
  return result;
}

void copy_samples(const File& from, File& to, const std::string& group, std::int64_t n_row) {
  to.create_group(group);
  const RowNames names = read_sample_names(from, group);
  for (const auto& name : names.name) to.copy_rows_from(from, group + "/" + name, n_row);
  if (!names.name.empty())
    to.write_attribute(group, kColumns, from.read_text_attribute(group, kColumns));
  to.write_attribute(group, "n_row", std::span<const std::int64_t>(&n_row, 1));
}

std::vector<Event> read_events(const File& file, std::int64_t first, std::int64_t n) {
  const auto time = read_column<double>(file, "/events/time", first, n);
  const auto code = file.read_text_rows("/events/code", first, n);
  const auto message = file.read_text_rows("/events/message", first, n);
  const auto offset = read_column<std::int64_t>(file, "/events/cell_offset", first, n + 1);
  check(offset.front() >= 0 && std::ranges::is_sorted(offset),
        file.path() + ": the cells of events are out of order. The file is damaged.",
        Exit::kFileError);
  const auto cell = read_column<std::int64_t>(file, "/events/cell_id", offset.front(),
                                              offset.back() - offset.front());
  std::vector<Event> event;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const auto at = [&](std::size_t k) { return cell.begin() + (offset[k] - offset.front()); };
    event.push_back({time[i], code[i], {at(i), at(i + 1)}, message[i]});
  }
  return event;
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
  const std::int64_t n_cell =
      read_column<std::int64_t>(from, "/events/cell_offset", n_row, 1).at(0);
  to.create_group("/events");
  for (const char* name : {"/events/time", "/events/code", "/events/message"})
    to.copy_rows_from(from, name, n_row);
  to.copy_rows_from(from, "/events/cell_id", n_cell);
  to.copy_rows_from(from, "/events/cell_offset", n_row + 1);
  to.write_attribute("/events", "n_row", std::span<const std::int64_t>(&n_row, 1));
  return n_cell;
}

}  // namespace acinus::io
