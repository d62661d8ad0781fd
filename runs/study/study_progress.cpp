#include "runs/study/study_progress.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "core/parallel/clock.hpp"
#include "runs/session/standard_streams.hpp"

namespace acinus::runs {

std::string short_duration(double s) {
  if (s < 10) return fmt::format("{:.1f} s", s);
  if (s < 120) return fmt::format("{:.0f} s", s);
  if (s < 7200) return fmt::format("{:.1f} min", s / 60);
  if (s < 2 * 86400) return fmt::format("{:.1f} h", s / 3600);
  return fmt::format("{:.1f} d", s / 86400);
}

StudyProgress::StudyProgress(const StudyPlan& plan, const std::string& root, int jobs, bool quiet)
    : plan_(plan), costs_(plan, root), jobs_(jobs), quiet_(quiet), terminal_(can_rewrite_lines()) {}

void StudyProgress::show(const StudyCounts& counts, const std::vector<ActiveRun>& active) {
  const double now = wall_seconds();
  if (quiet_ || now - last_ < (terminal_ ? 1 : 60)) return;
  last_ = now;
  std::vector<RunningCost> running;
  std::string text;
  for (const ActiveRun& a : active) {
    const RunProgress p = read_progress(a);
    running.push_back({a.run, p.wall_s, p.left_s});
    text += fmt::format(
        "  {} {}", plan_.runs[a.run].name,
        p.starting ? "starting"
                   : fmt::format("{} of {}", short_duration(p.time_s), short_duration(p.end_s)));
  }
  std::string line = fmt::format("{} of {} done", counts.done, counts.all);
  if (counts.failed > 0) line += fmt::format(", {} failed", counts.failed);
  if (const auto left = estimate_time_left(plan_, costs_, counts.waiting, running, jobs_))
    line += fmt::format("; about {} left", short_duration(*left));
  line += ";" + (active.empty() ? " waiting for other processes" : text);
  fmt::print("{}{}{}", terminal_ ? "\r\x1b[K" : "", line, terminal_ ? "" : "\n");
  line_open_ = terminal_;
  std::fflush(stdout);
}

void StudyProgress::note(const std::string& text) {
  if (quiet_) return;
  finish();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void StudyProgress::finish() {
  if (line_open_) fmt::print("\n");
  line_open_ = false;
  std::fflush(stdout);
}

}  // namespace acinus::runs
