#pragma once
/// Rules between keys of a scene; what concerns one key alone stands in the registry.

#include "runs/scene/report.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Adds every broken rule to the report. Rules about keys that are already reported are left out.
void check_rules(const Scene& scene, Report& report);

}  // namespace acinus::runs
