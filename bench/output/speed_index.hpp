#pragma once
/// How fast this machine is at this moment, so that figures of different days can be compared.

namespace acinus::bench {

/// CPU time of a fixed piece of work, ms: twenty sweeps of a Jacobi iteration over 32,000 doubles,
/// fitting a second-level cache, as most kernels do; median of nine.
double measure_speed_index();

}  // namespace acinus::bench
