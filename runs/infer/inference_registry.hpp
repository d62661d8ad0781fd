#pragma once
/// Registry of the keys of an inference, visited by reader, schema and `explain` as that of scenes.

#include <string>
#include <vector>

#include "runs/infer/inference.hpp"
#include "runs/scene/entries.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Visits every key of the inference, with its own members as values.
void describe(Visitor& visitor, Inference& inference);

/// All keys in canonical order, with "inference." before their names; built once.
const std::vector<Entry>& inference_entries();

/// JSON Schema of an inference, like scene_schema().
std::string inference_schema();

}  // namespace acinus::runs
