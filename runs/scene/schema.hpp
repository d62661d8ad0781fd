#pragma once
/// The JSON Schema of a scene, made from the registry.

#include <string>

namespace acinus::runs {

/// JSON Schema (draft 2020-12) that editors can use for completion and checks. It knows types,
/// units by dimension, ranges of plain numbers and choices; ranges of quantities and rules between
/// keys stay with `acinus check`.
std::string scene_schema();

}  // namespace acinus::runs
