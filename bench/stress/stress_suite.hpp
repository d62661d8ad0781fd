#pragma once
/// The stress suite: random scenes, each run as a user runs it, and judged by what it leaves
/// behind.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Runs options.seeds scenes from seed options.first on, two at a time at most, and counts how they
/// end, for each family. Prints one line per scene that did not end clean. A row has not passed
/// when one of its scenes failed in a way the run itself did not tell. With options.folder the
/// scenes and runs that did not end clean stay there in folders seed_N, beside verdicts.jsonl with
/// a line per scene; scenes that were judged before with this very program are not run again.
/// Without a folder nothing stays.
/// @throws Error(kFileError) if scenes or results cannot be written or read
BenchTable bench_stress(const BenchOptions& options);

}  // namespace acinus::bench
