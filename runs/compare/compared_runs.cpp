#include "runs/compare/compared_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/numbers/time_grid.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/shell_quote.hpp"

namespace acinus::runs {
namespace {

double end_of(const io::RunReader& reader) { return reader.time_s(reader.n_frame() - 1); }

double same_frame(const io::RunReader& reader) {
  constexpr double kMostTolerance = 1, kToleranceShare = 1e-3;  // s; of the duration
  return std::clamp(kToleranceShare * (end_of(reader) - reader.time_s(0)), kSameTime,
                    kMostTolerance);
}

std::string hours_text(double s) { return fmt::format("{:.4g} h", s / 3600); }

/// Opens a run and checks that its summary is of its last frames; that of a run in progress is
/// outdated.
ComparedRun open_run(const std::string& folder) {
  check(!is_being_written(folder),
        fmt::format("{}: the run goes on: a process writes in this folder. Wait until it ends, or "
                    "stop it, before it is compared.",
                    folder));
  ComparedRun run{read_summary(folder), io::RunReader(folder + "/run.vtkhdf"), {}};
  check(run.reader.n_frame() > 0,
        fmt::format("{}: holds no frame: the run is {} at {}. There is nothing to compare.", folder,
                    name_of_choice(run.summary.status), hours_text(run.summary.simulated_s)));
  check(end_of(run.reader) <= run.summary.simulated_s + same_frame(run.reader),
        fmt::format("{}: has frames until {}, but its summary is of an earlier end, {}: it was "
                    "resumed and killed. Go on with it: acinus run SCENE --resume --out {}",
                    folder, hours_text(end_of(run.reader)), hours_text(run.summary.simulated_s),
                    quote_for_shell(folder)));
  return run;
}

/// Frame nearest to a time, within `reach` (s); -1 if there is none.
int find_frame(const io::RunReader& reader, double time, double reach) {
  int nearest = -1;
  for (int k = 0; k < reader.n_frame(); ++k) {
    const double distance = std::abs(reader.time_s(k) - time);
    if (distance > reach) continue;
    nearest = k;
    reach = distance;
  }
  return nearest;
}

bool is_until(double time, const io::RunReader& reader, std::optional<double> until) {
  return !until || time <= *until + same_frame(reader);
}

}  // namespace

std::vector<ComparedRun> open_compared_runs(const std::vector<std::string>& folders,
                                            std::optional<double> until) {
  std::vector<ComparedRun> runs;
  for (const std::string& folder : folders) runs.push_back(open_run(folder));
  const io::RunReader& first = runs[0].reader;
  const double reach = same_frame(first);
  for (int k = 0; k < first.n_frame() && is_until(first.time_s(k), first, until); ++k) {
    std::vector<int> same;
    for (const ComparedRun& r : runs) same.push_back(find_frame(r.reader, first.time_s(k), reach));
    if (std::ranges::find(same, -1) != same.end()) continue;
    for (std::size_t r = 0; r < runs.size(); ++r) runs[r].frame.push_back(same[r]);
  }
  check(!runs[0].frame.empty(),
        fmt::format("no frame at the same time in {}{}. Give the runs the same output.every.",
                    fmt::join(folders, " and "), until ? " until " + hours_text(*until) : ""));
  return runs;
}

Shortfall find_shortfall(const ComparedRun& run, std::optional<double> until) {
  const RunSummary& s = run.summary;
  const double last = run.time_of_last(), end = end_of(run.reader), same = same_frame(run.reader);
  if (until && end < *until - same)
    return {fmt::format("{} has frames until {} only, not until {} ({})", s.folder, hours_text(end),
                        hours_text(*until), name_of_choice(s.status)),
            true};
  if (until && std::abs(last - *until) > same)
    return {fmt::format("{} has no frame at {} that all runs have", s.folder, hours_text(*until))};
  if (until) return {};
  if (s.status != RunOutcome::kCompleted)
    return {fmt::format("{} {} at {}{}", s.folder,
                        s.status == RunOutcome::kStopped ? "was stopped" : "failed",
                        hours_text(s.simulated_s), s.cause.empty() ? "" : ": " + s.cause),
            true};
  if (end > last + same)
    return {fmt::format("{} ends at {}, but the last frame that all runs have is at {}", s.folder,
                        hours_text(end), hours_text(last))};
  return {};
}

std::string describe_unshared_frames(const ComparedRun& run, std::optional<double> until) {
  int frames = 0;
  for (int k = 0; k < run.reader.n_frame(); ++k)
    if (is_until(run.reader.time_s(k), run.reader, until)) ++frames;
  const auto shared = static_cast<int>(run.frame.size());
  if (shared == frames) return {};
  return fmt::format(
      "compared at {} common times; {} of {} frames of {} are at other times and not used", shared,
      frames - shared, frames, run.summary.folder);
}

}  // namespace acinus::runs
