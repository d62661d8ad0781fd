#include "runs/session/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/parallel/clock.hpp"
#include "runs/session/result_text.hpp"
#include "runs/session/standard_streams.hpp"

namespace acinus::runs {
namespace {

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

/// Completed share of the present phase as " 34 %"; empty if its end is unknown.
std::string percent_of_phase(const coupling::World& world, double end) {
  const coupling::Clock& clock = world.state.clock;
  const double start = clock.phase == coupling::Phase::kRun ? clock.origin : clock.phase_start;
  if (!std::isfinite(end) || end <= start) return "";
  const double share = std::clamp((clock.time - start) / (end - start), 0.0, 1.0);
  return fmt::format(" {:.0f} %", std::floor(100 * share));
}

/// End of the present phase on the clock of the state, s; infinite if it depends on the settling of
/// the tissue.
double end_of_phase(const coupling::World& world, double end) {
  const coupling::Clock& clock = world.state.clock;
  const coupling::StartUp& start_up = world.params.start_up;
  switch (clock.phase) {
    case coupling::Phase::kGrow:
      return clock.phase_start + start_up.growth_time;
    case coupling::Phase::kAdhere:
      return clock.phase_start + start_up.adhesion_ramp;
    case coupling::Phase::kSettle:
      return std::numeric_limits<double>::infinity();
    case coupling::Phase::kRun:
      break;
  }
  return clock.origin + end;
}

}  // namespace

Progress::Progress(const RunOptions& options, double end, const Ranks& ranks)
    : options_(options),
      ranks_(ranks),
      end_(end),
      started_(wall_seconds()),
      // mpirun gives its processes a terminal even where it writes to a file itself.
      terminal_(ranks.size() == 1 && can_rewrite_lines()) {}

void Progress::begin(const coupling::World& world) {
  started_ = wall_seconds();
  phase_ = world.state.clock.phase;
  left_.begin(started_, world.state.clock.time);
}

void Progress::step(const coupling::World& world) {
  if (options_.quiet || !ranks_.is_root()) return;
  const coupling::Clock& clock = world.state.clock;
  // A phase of the start-up says nothing about how fast the next one goes.
  if (clock.phase != phase_) left_.restart();
  phase_ = clock.phase;
  const double now = wall_seconds(), every = options_.progress_json ? 1 : terminal_ ? 0.2 : 60;
  left_.add(now, clock.time);
  if (now - last_ < every) return;
  last_ = now;
  print(world);
}

std::string Progress::line_of(const coupling::World& world) const {
  const coupling::State& s = world.state;
  const bool running = s.clock.phase == coupling::Phase::kRun;
  const double time = coupling::time_since_start(world), end = end_of_phase(world, end_);
  const std::optional<double> left = std::isfinite(end) ? left_.until(end) : std::nullopt;
  std::string line = fmt::format(
      "{}{}  {} of {}  {}", phase_name(s.clock.phase), percent_of_phase(world, end),
      format_duration(running ? time : s.clock.time),
      running ? format_duration(end_) : "at most " + format_duration(s.clock.time - time),
      describe_cells(dcm::count_cells(s.dcm), static_cast<int>(s.cbm.n_cell())));
  if (options_.verbose)
    line += fmt::format("  dt {:.3g} s  {:.0f}x real time", s.clock.last_step, left_.rate());
  if (left)
    line +=
        fmt::format("  about {}{} left", format_duration(*left), running ? "" : " of this phase");
  return line;
}

void Progress::print(const coupling::World& world) {
  const coupling::State& s = world.state;
  const bool running = s.clock.phase == coupling::Phase::kRun;
  const double time = coupling::time_since_start(world), wall = wall_seconds() - started_;
  const double end = end_of_phase(world, end_);
  const std::optional<double> left = std::isfinite(end) ? left_.until(end) : std::nullopt;
  const int dcm = dcm::count_cells(s.dcm), cbm = static_cast<int>(s.cbm.n_cell());
  if (options_.progress_json) {
    fmt::print(
        "{{\"phase\":\"{}\",\"time_s\":{},\"end_s\":{},\"dcm\":{},\"cbm\":{},\"dt_s\":{},\"wall_"
        "s\":{},\"eta_s\":{}}}\n",
        phase_name(s.clock.phase), time, end_, dcm, cbm, s.clock.last_step, wall,
        running && left ? fmt::format("{}", *left) : "null");
  } else {
    fmt::print("{}{}{}", terminal_ ? "\r\x1b[K" : "", line_of(world), terminal_ ? "" : "\n");
    line_open_ = terminal_;
  }
  std::fflush(stdout);
}

void Progress::finish() {
  if (line_open_) fmt::print("\r\x1b[K");
  line_open_ = false;
  std::fflush(stdout);
}

void Progress::note(const std::string& text) {
  spdlog::info(text);
  if (options_.quiet || options_.progress_json || !ranks_.is_root()) return;
  finish();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void Progress::detail(const std::string& text) {
  if (options_.verbose)
    note(text);
  else
    spdlog::info(text);
}

void Progress::warn(const std::string& text) {
  spdlog::warn(text);
  if (!ranks_.is_root()) return;
  finish();
  fmt::print(stderr, "acinus: warning: {}\n", text);
}

}  // namespace acinus::runs
