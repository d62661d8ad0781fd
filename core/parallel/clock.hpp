#pragma once
/// System clocks.

#include <ctime>

namespace acinus {

/// Time of a system clock, s.
double read_clock(clockid_t clock);

/// Monotonic wall time, s; only differences have a meaning.
double wall_seconds();

/// CPU time of all threads of this process since its start, s.
double cpu_seconds();

}  // namespace acinus
