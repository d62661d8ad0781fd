#pragma once
/// Momentary speed of the machine, for comparison of figures of different days.

namespace acinus::bench {

/// CPU time of a fixed task, ms: twenty Jacobi sweeps over 32,000 doubles, which fit a second-level
/// cache as in most kernels; median of nine.
double measure_speed_index();

}  // namespace acinus::bench
