#pragma once
/// Laws of spheres that the runs of a study ask for, calibrated once before any of them starts.

#include <map>
#include <string>
#include <vector>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Finds or makes the law of every cell type with stiffness_correction "auto"; the runs then find
/// it in the cache.
/// @param threads  for a calibration
/// @param failed   out: run name -> why it cannot have its law
/// @return whether a signal stopped a calibration
bool find_laws(const std::vector<const StudyRun*>& runs, int threads, bool quiet,
               std::map<std::string, std::string>& failed);

}  // namespace acinus::runs
