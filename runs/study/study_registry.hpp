#pragma once
/// Registry of study keys, visited by reader, schema and `explain` as that of scenes.

#include <string>
#include <vector>

#include "runs/scene/entries.hpp"
#include "runs/scene/visitor.hpp"
#include "runs/study/study.hpp"

namespace acinus::runs {

/// Visits every key of the study, with the study's own members as values.
void describe(Visitor& visitor, Study& study);

/// All keys in canonical order; built once.
const std::vector<Entry>& study_entries();

/// JSON Schema of a study, like scene_schema().
std::string study_schema();

}  // namespace acinus::runs
