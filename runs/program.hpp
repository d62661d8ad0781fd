#pragma once
/// Entry points of the programs.

#include <csignal>

#include "core/parallel/memory.hpp"
#include "runs/session/exit_code.hpp"
#include "runs/session/standard_streams.hpp"

namespace acinus::runs {

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
