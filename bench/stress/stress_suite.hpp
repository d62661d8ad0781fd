#pragma once
/// Stress suite: random scenes run as by a user and judged by the files they leave.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Runs options.seeds scenes from seed options.first on, at most two at a time, and counts their
/// outcomes per family. Prints one line per scene that did not end clean. A row fails if one of its
/// scenes failed in a way that the run did not report. With options.folder, scenes and runs that
/// did not end clean are kept in folders seed_N beside verdicts.jsonl, a line per scene; scenes
/// judged before with this very program are not repeated. Without a folder nothing is kept.
/// @throws Error(kFileError) if scenes or results cannot be written or read
BenchTable bench_stress(const BenchOptions& options);

}  // namespace acinus::bench
