#pragma once
/// JSON Schema of a scene, made from the registry.

#include <functional>
#include <string>

#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// JSON Schema (draft 2020-12) that editors can use for completion and checks. It knows types,
/// units by dimension, ranges of plain numbers and choices; ranges of quantities and rules between
/// keys stay with `acinus check`.
std::string scene_schema();

/// JSON Schema of any registry.
/// @param extends  meaning of the key of that name
std::string make_schema(const char* title, const char* extends,
                        const std::function<void(Visitor&)>& describe);

}  // namespace acinus::runs
