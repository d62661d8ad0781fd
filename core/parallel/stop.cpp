#include "core/parallel/stop.hpp"

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
#include "core/parallel/clock.hpp"

namespace acinus {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The only things a signal handler may touch.
volatile std::sig_atomic_t g_last = 0, g_count = 0;
int g_depth = 0;
double g_limit = kNever;  ///< s, wall-time limit on the clock of wall_seconds()
/// Last agreement among the processes that share a run.
enum class Agreement { kNone, kGoOn, kStop } g_agreement = Agreement::kNone;

bool has_signal() { return g_depth > 0 && g_last != 0; }

void remember(int signal) {
  g_last = signal;
  g_count = g_count + 1;
}

struct sigaction action_of(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  return action;
}

/// Writes to standard error; async-signal-safe, for handlers.
void write_error(std::string_view text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
}

void end_at_limit(int /*signal*/) {
  write_error("acinus: stopped by the wall-time limit while a run was prepared\n");
  _exit(static_cast<int>(Exit::kStopped));
}

void end_at_signal(int signal) {
  const char* name = sigabbrev_np(signal);
  write_error("acinus: stopped by ");
  write_error(name != nullptr ? "SIG" : "a real-time signal");
  write_error(name != nullptr ? name : "");
  write_error(" while a run was prepared\n");
  _exit(static_cast<int>(Exit::kStopped));
}

bool is_any_of(int signal, std::initializer_list<int> list) {
  return std::ranges::find(list, signal) != list.end();
}

/// Test for a signal whose present disposition must be kept.
bool keeps(int signal, const struct sigaction& set) {
  for (const auto ours : {static_cast<void (*)(int)>(SIG_DFL), &remember, &end_at_signal})
    if (set.sa_handler == ours) return false;
  if (set.sa_handler == SIG_IGN) return !is_any_of(signal, {SIGINT, SIGQUIT});
  return !is_any_of(signal, {SIGINT, SIGQUIT, SIGTERM});
}

/// Sets the alarm. @param seconds  0: no alarm
void set_alarm(double seconds) {
  constexpr double kLongest = 1e8;  // s
  itimerval timer{};
  seconds = std::min(seconds, kLongest);
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

std::vector<int> stop_signals() {
  std::vector<int> all{SIGHUP,  SIGINT,    SIGQUIT, SIGUSR1,   SIGUSR2, SIGALRM, SIGTERM,
                       SIGXCPU, SIGVTALRM, SIGPROF, SIGSTKFLT, SIGPOLL, SIGPWR};
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) all.push_back(signal);
  return all;
}

SignalHandlers::SignalHandlers(void (*handler)(int)) {
  const struct sigaction ours = action_of(handler);
  for (const int signal : stop_signals()) {
    struct sigaction set {};
    if (sigaction(signal, nullptr, &set) != 0 || keeps(signal, set)) continue;
    sigaction(signal, &ours, nullptr);
    before_.emplace_back(signal, set);
  }
}

SignalHandlers::~SignalHandlers() {
  for (const auto& [signal, set] : before_) sigaction(signal, &set, nullptr);
}

StopSignals::StopSignals() {
  if (g_depth++ > 0) return;
  g_last = 0;
  g_count = 0;
  if (g_agreement == Agreement::kStop) g_agreement = Agreement::kGoOn;
  handlers_.emplace(remember);
}

StopSignals::~StopSignals() {
  handlers_.reset();
  --g_depth;
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
  if (has_signal()) {
    const char* name = sigabbrev_np(g_last);
    return fmt::format("signal {}{}", static_cast<int>(g_last),
                       name != nullptr ? fmt::format(" (SIG{})", name) : "");
  }
  return is_asked_to_stop() ? "the wall-time limit" : "a request to another process";
}

ExitAtLimit::ExitAtLimit() {
  if (g_limit == kNever) return;
  constexpr double kAtOnce = 1e-3;  // s
  const struct sigaction action = action_of(end_at_limit);
  sigaction(SIGALRM, &action, &before_);
  set_alarm(std::max(g_limit - wall_seconds(), kAtOnce));
}

ExitAtLimit::~ExitAtLimit() {
  if (g_limit == kNever) return;
  set_alarm(0);
  sigaction(SIGALRM, &before_, nullptr);
}

ExitAtSignal::ExitAtSignal() : handlers_(end_at_signal) {}

}  // namespace acinus
