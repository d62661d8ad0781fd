#pragma once
/// The laws that scenes ask for with "auto".

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// The law of every cell type that asks for "auto": found in the cache, or calibrated now and kept
/// there. The cache is acinus/laws in XDG_CACHE_HOME or ~/.cache, its names hashes of the
/// constants. Of several processes that ask for the same law one calibrates, the others wait.
/// @return exit code of a calibration that was stopped or failed, else 0
int resolve_corrections(Scene& scene, int threads, bool quiet);

}  // namespace acinus::runs
