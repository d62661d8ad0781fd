#pragma once
/// Cache of the stiffness laws that scenes ask for with "auto".

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Replaces stiffness_correction "auto" of every cell type by a shipped law, else by a law file of
/// the cache, calibrated now if it is missing. Scenes of deformable cells only stay as they are.
/// The cache is acinus/laws in XDG_CACHE_HOME or
/// ~/.cache; file names are hashes of the constants. Of concurrent processes that need the same law
/// one calibrates and the others wait.
/// @return exit code: 0, or that of a calibration that stopped or failed
int resolve_corrections(Scene& scene, int threads, bool quiet);

}  // namespace acinus::runs
