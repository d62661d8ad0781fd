#include "runs/session/stop_signals.hpp"

#include <csignal>
#include <initializer_list>

namespace acinus::runs {
namespace {

// The only things a signal handler may touch.
volatile std::sig_atomic_t g_last = 0, g_count = 0;
int g_depth = 0;

void remember(int signal) {
  g_last = signal;
  g_count = g_count + 1;
}

void handle_with(void (*handler)(int)) {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) std::signal(signal, handler);
}

}  // namespace

StopSignals::StopSignals() {
  if (g_depth++ > 0) return;
  g_last = 0;
  g_count = 0;
  handle_with(remember);
}

StopSignals::~StopSignals() {
  if (--g_depth == 0) handle_with(SIG_DFL);
}

int stop_signal() { return g_last; }
int count_stop_signals() { return g_count; }

}  // namespace acinus::runs
