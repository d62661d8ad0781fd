#include "runs/study/study_laws.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "runs/calibrate/law_cache.hpp"

namespace acinus::runs {

bool resolve_laws(const std::vector<const StudyRun*>& runs, int threads, bool quiet,
                  std::map<std::string, std::string>& failed) {
  for (const StudyRun* run : runs) {
    const bool asks = std::ranges::any_of(run->scene.cell_types, [](const auto& type) {
      return type.second.cbm.stiffness_correction == "auto";
    });
    if (!asks) continue;
    Scene scene = run->scene;  // its law's file must not enter the run's identity
    try {
      if (resolve_corrections(scene, threads, quiet) != 0) return true;  // it was stopped
    } catch (const Error& error) {
      failed[run->name] = error.what();
    }
  }
  return false;
}

}  // namespace acinus::runs
