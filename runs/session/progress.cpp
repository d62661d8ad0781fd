#include "runs/session/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/timing.hpp"

namespace acinus::runs {
namespace {

std::string short_time(double s) {
  if (s < 120) return fmt::format("{:.0f} s", s);
  if (s < 7200) return fmt::format("{:.1f} min", s / 60);
  return fmt::format("{:.1f} h", s / 3600);
}

const char* phase_name(coupling::Phase p) {
  switch (p) {
    case coupling::Phase::kGrow:
      return "start-up: growing";
    case coupling::Phase::kAdhere:
      return "start-up: adhering";
    case coupling::Phase::kSettle:
      return "start-up: settling";
    case coupling::Phase::kRun:
      break;
  }
  return "running";
}

}  // namespace

Progress::Progress(const RunOptions& options, double end)
    : options_(options),
      end_(end),
      started_(wall_seconds()),
      terminal_(isatty(STDOUT_FILENO) != 0) {}

void Progress::begin(const coupling::World& world) {
  first_time_ = world.state.clock.time;
  started_ = wall_seconds();
}

void Progress::step(const coupling::World& world) {
  if (options_.quiet) return;
  const double now = wall_seconds(), every = options_.progress_json ? 1 : terminal_ ? 0.2 : 60;
  if (now - last_ < every) return;
  last_ = now;
  print(world);
}

void Progress::print(const coupling::World& world) {
  const coupling::State& s = world.state;
  const double time = coupling::time_since_start(world), wall = wall_seconds() - started_;
  const double done = std::max(s.clock.time - first_time_, 1e-9);
  const double left =
      s.clock.phase == coupling::Phase::kRun ? end_ - time : end_ - std::min(time, 0.0);
  const double eta = wall / done * std::max(left, 0.0);
  const int dcm = dcm::count_cells(s.dcm), cbm = static_cast<int>(s.cbm.n_cell());
  if (options_.progress_json) {
    fmt::print(
        "{{\"phase\":\"{}\",\"time_s\":{},\"end_s\":{},\"dcm\":{},\"cbm\":{},\"dt_s\":{},\"wall_"
        "s\":{},\"eta_s\":{}}}\n",
        phase_name(s.clock.phase), time, end_, dcm, cbm, s.clock.last_step, wall, eta);
  } else {
    const std::string line = fmt::format(
        "{}  {} of {}  {} DCM + {} CBM cells  dt {:.3g} s  {:.0f}x real time  about {} left",
        phase_name(s.clock.phase),
        short_time(s.clock.phase == coupling::Phase::kRun ? time : s.clock.time), short_time(end_),
        dcm, cbm, s.clock.last_step, done / std::max(wall, 1e-9), short_time(eta));
    fmt::print("{}{}{}", terminal_ ? "\r\x1b[K" : "", line, terminal_ ? "" : "\n");
    line_open_ = terminal_;
  }
  std::fflush(stdout);
}

void Progress::finish() {
  if (line_open_) fmt::print("\n");
  line_open_ = false;
  std::fflush(stdout);
}

void Progress::note(const std::string& text) {
  spdlog::info(text);
  if (options_.quiet || options_.progress_json) return;
  finish();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void Progress::warn(const std::string& text) {
  spdlog::warn(text);
  finish();
  fmt::print(stderr, "acinus: warning: {}\n", text);
}

}  // namespace acinus::runs
