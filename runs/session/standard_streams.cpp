#include "runs/session/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::runs {
namespace {

/// State of one output descriptor.
struct Sink {
  int descriptor;
  bool closed = false;   ///< when the program started
  bool dropped = false;  ///< nothing more can be printed
  int error = 0;         ///< errno of the failed write, 0 for a closed pipe
};

// Streams of C belong to the process, so what became of them does too.
Sink g_out{STDOUT_FILENO}, g_error{STDERR_FILENO};

void drop(Sink& sink, int error) {
  sink.dropped = true;
  if (error == EPIPE) return;
  sink.error = error;
  if (&sink == &g_out)
    fmt::print(stderr, "acinus: standard output: {}; what is printed from here on is lost\n",
               sink.closed ? "it is closed" : std::strerror(error));
}

ssize_t print(void* cookie, const char* text, std::size_t size) {
  Sink& sink = *static_cast<Sink*>(cookie);
  if (!sink.dropped) {
    const int error = sink.closed ? EBADF : io::write_stream(sink.descriptor, {text, size});
    if (error != 0) drop(sink, error);
  }
  return static_cast<ssize_t>(size);
}

/// Opens a C stream that writes to the sink.
std::FILE* open_stream(Sink& sink, int buffering) {
  std::FILE* file =
      fopencookie(&sink, "w", {.read = nullptr, .write = print, .seek = nullptr, .close = nullptr});
  if (file != nullptr) std::setvbuf(file, nullptr, buffering, BUFSIZ);
  return file;
}

bool is_closed(int descriptor) { return fcntl(descriptor, F_GETFD) < 0 && errno == EBADF; }

}  // namespace

void guard_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  g_out.closed = is_closed(STDOUT_FILENO);
  g_error.closed = is_closed(STDERR_FILENO);
  // open() gives the lowest free descriptor: the one that was found closed.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (is_closed(descriptor)) open("/dev/null", O_RDWR);
  const int buffering = isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF;
  if (std::FILE* error = open_stream(g_error, _IONBF); error != nullptr) stderr = error;
  if (std::FILE* out = open_stream(g_out, buffering); out != nullptr) stdout = out;
}

int finish_printing(int code) {
  std::fflush(stdout);
  return code == 0 && g_out.error != 0 ? static_cast<int>(Exit::kFileError) : code;
}

bool can_rewrite_lines() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && terminal != nullptr &&
         std::string_view(terminal) != "dumb" && *terminal != '\0';
}

}  // namespace acinus::runs
