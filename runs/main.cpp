#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "core/error.hpp"
#include "runs/cli.hpp"

/// Turns every exception into a message and an exit code.
int main(int argc, char** argv) {
  // A file-size limit then shows as a failed write, which is reported, instead of killing the
  // program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return acinus::runs::run_cli(argc, argv);
  } catch (const acinus::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "internal error\n");
  }
  return static_cast<int>(acinus::Exit::kInternal);
}
