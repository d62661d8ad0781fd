#include "service/report/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "io/inside.hpp"
#include "runs/session/run_folder.hpp"

namespace acinus::service {
namespace fs = std::filesystem;

bool attempt(RunRecord& run, const std::string& what, const std::function<void()>& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    if (error.code() == Exit::kInternal) throw;
    const std::string line = fmt::format("{}: {}", what, error.what());
    if (std::ranges::find(run.damage, line) == run.damage.end()) run.damage.push_back(line);
    return false;
  }
}

RunRecord read_run_record(const std::string& folder) {
  RunRecord run;
  run.folder = folder;
  const std::string file = folder + "/run.vtkhdf", summary = folder + "/summary.json";
  std::error_code code;
  const bool has_file = fs::exists(fs::symlink_status(file, code)),
             has_summary = fs::exists(fs::symlink_status(summary, code));
  check(has_file || has_summary,
        fmt::format("{}: holds neither run.vtkhdf nor summary.json. Name a folder that "
                    "`acinus run` wrote.",
                    folder),
        Exit::kFileError);
  attempt(run, "lock of the folder", [&] { run.going_on = runs::is_being_written(folder); });
  if (has_summary)
    attempt(run, "summary", [&] { run.summary = io::read_text_inside(folder, "summary.json"); });
  if (!has_file) {
    run.damage.emplace_back("run.vtkhdf is missing: no frames, no tables");
    return run;
  }
  attempt(run, "run file", [&] {
    check(io::is_file_inside(folder, "run.vtkhdf"),
          file + ": is a link or no regular file, and is not followed. Name the folder it lies in.",
          Exit::kFileError);
    run.reader.emplace(file);
  });
  if (!run.reader) return run;
  attempt(run, "provenance", [&] { run.provenance = run.reader->provenance(); });
  attempt(run, "series", [&] { run.series = run.reader->series(); });
  attempt(run, "observables", [&] {
    run.observables = run.reader->observables();
    run.observable_unit = run.reader->observable_unit();
  });
  attempt(run, "events", [&] { run.events = run.reader->events(); });
  return run;
}

std::optional<io::Frame> read_frame(RunRecord& run, int frame) {
  std::optional<io::Frame> out;
  attempt(run, fmt::format("frame {}", frame), [&] { out = run.reader->frame(frame); });
  return out;
}

std::optional<io::Table> read_cell_table(RunRecord& run, int frame) {
  std::optional<io::Table> out;
  attempt(run, fmt::format("frame {}", frame), [&] { out = run.reader->cells(frame); });
  return out;
}

std::optional<io::FieldFrame> read_fields(RunRecord& run, int frame, double time_s) {
  constexpr double kSameTime = 1e-6;  // s
  std::optional<io::FieldFrame> out;
  attempt(run, fmt::format("fields of frame {}", frame), [&] {
    out = io::read_fields(run.folder, static_cast<std::size_t>(frame));
    if (!out || std::abs(out->time_s - time_s) <= kSameTime) return;
    const double other = out->time_s;
    out.reset();
    throw Error(fmt::format("they are of t = {} s, the frame of {} s", other, time_s),
                Exit::kFileError);
  });
  return out;
}

std::vector<double> table_column(const io::Table& table, const std::string& name) {
  for (const io::Column& c : table.columns)
    if (c.name == name) return c.value;
  for (const io::IdColumn& c : table.ids)
    if (c.name == name) return {c.value.begin(), c.value.end()};
  return {};
}

}  // namespace acinus::service
