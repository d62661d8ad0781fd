#pragma once
/// Stiffness laws of the spheres of a study, calibrated once before its runs start.

#include <map>
#include <string>
#include <vector>

#include "runs/study/plan.hpp"

namespace acinus::runs {

/// Provides the law of every cell type with stiffness_correction "auto" in the cache, where the
/// runs find it.
/// @param threads  of a calibration
/// @param failed   receives run name -> reason why its law is missing
/// @return true if a signal stopped a calibration
bool resolve_laws(const std::vector<const StudyRun*>& runs, int threads, bool quiet,
                  std::map<std::string, std::string>& failed);

}  // namespace acinus::runs
