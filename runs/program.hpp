#pragma once
/// Entry points of the programs: exceptions as messages and exit codes.

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "core/error.hpp"
#include "core/parallel/memory.hpp"
#include "runs/session/standard_streams.hpp"
#include "runs/session/together.hpp"

namespace acinus::runs {

/// Runs a function and turns any exception into a message and an exit code.
/// @param work  callable without arguments that returns an exit code
template <class Work>
int exit_code_of(Work work) {
  try {
    return work();
  } catch (const FailedElsewhere& failed) {
    return failed.code();
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "internal error\n");
  }
  return static_cast<int>(Exit::kInternal);
}

/// Runs a whole program: sets up streams and memory, and turns exceptions and lost output into exit
/// codes.
template <class Work>
int run_program(Work work) {
  // A file-size limit then shows as a failed write, which is reported, instead of killing the
  // program.
  std::signal(SIGXFSZ, SIG_IGN);
  guard_standard_streams();
  keep_freed_memory();
  return finish_printing(exit_code_of(work));
}

}  // namespace acinus::runs
