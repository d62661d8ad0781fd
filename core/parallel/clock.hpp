#pragma once
/// Clocks of the system.

#include <ctime>

namespace acinus {

/// Seconds of a clock of the system.
double read_clock(clockid_t clock);

/// Seconds of a clock that never jumps; only differences mean something.
double wall_seconds();

/// CPU seconds of all threads of this process since its start.
double cpu_seconds();

/// CPU seconds of the calling thread.
double thread_cpu_seconds();

}  // namespace acinus
