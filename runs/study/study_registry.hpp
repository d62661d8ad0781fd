#pragma once
/// The registry of study keys; reader, schema and `explain` visit it as they do that of scenes.

#include <string>
#include <vector>

#include "runs/scene/entries.hpp"
#include "runs/scene/visitor.hpp"
#include "runs/study/study.hpp"

namespace acinus::runs {

/// Shows the visitor every key of the study, with the study's own fields as values.
void describe(Visitor& visitor, Study& study);

/// Every key, in canonical order; built once.
const std::vector<Entry>& study_entries();

/// JSON Schema of a study, as scene_schema().
std::string study_schema();

}  // namespace acinus::runs
