#include "core/stop.hpp"

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "core/error.hpp"
#include "core/timing.hpp"

namespace acinus {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The only things a signal handler may touch.
volatile std::sig_atomic_t g_last = 0, g_count = 0;
int g_depth = 0;
double g_limit = kNever;  ///< on the clock of wall_seconds()
/// What processes that share a run agreed on.
enum class Agreement { kNone, kGoOn, kStop } g_agreement = Agreement::kNone;

bool has_signal() { return g_depth > 0 && g_last != 0; }

void remember(int signal) {
  g_last = signal;
  g_count = g_count + 1;
}

void handle_with(void (*handler)(int)) {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) std::signal(signal, handler);
}

void end_process(int /*signal*/) {
  constexpr std::string_view kText =
      "acinus: stopped by the wall-time limit while a run was prepared\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kText.data(), kText.size());
  _exit(static_cast<int>(Exit::kStopped));
}

/// @param seconds  0: no alarm
void set_alarm(double seconds) {
  constexpr double kLongest = 1e8;  // s
  itimerval timer{};
  seconds = std::min(seconds, kLongest);
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

StopSignals::StopSignals() {
  if (g_depth++ > 0) return;
  g_last = 0;
  g_count = 0;
  if (g_agreement == Agreement::kStop) g_agreement = Agreement::kGoOn;
  handle_with(remember);
}

StopSignals::~StopSignals() {
  if (--g_depth == 0) handle_with(SIG_DFL);
}

int count_stop_signals() { return g_count; }

WallTimeLimit::WallTimeLimit(double limit_s) : before_(g_limit) {
  g_limit = std::min(g_limit, wall_seconds() + limit_s);
}

WallTimeLimit::~WallTimeLimit() { g_limit = before_; }

bool is_asked_to_stop() { return has_signal() || (g_limit < kNever && wall_seconds() > g_limit); }

void agree_to_stop(bool stop) { g_agreement = stop ? Agreement::kStop : Agreement::kGoOn; }

bool stop_requested() {
  return g_agreement == Agreement::kNone ? is_asked_to_stop() : g_agreement == Agreement::kStop;
}

std::string describe_stop() {
  if (!stop_requested()) return {};
  if (has_signal()) return fmt::format("signal {}", static_cast<int>(g_last));
  return is_asked_to_stop() ? "the wall-time limit" : "a request to another process";
}

ExitAtLimit::ExitAtLimit() {
  if (g_limit == kNever) return;
  constexpr double kAtOnce = 1e-3;  // s
  std::signal(SIGALRM, end_process);
  set_alarm(std::max(g_limit - wall_seconds(), kAtOnce));
}

ExitAtLimit::~ExitAtLimit() {
  if (g_limit == kNever) return;
  set_alarm(0);
  std::signal(SIGALRM, SIG_DFL);
}

}  // namespace acinus
