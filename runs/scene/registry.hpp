#pragma once
/// Registry of scene keys: one entry per parameter with its path, type, dimension, unit,
/// default, range and meaning, and with its effects: on what a change of it acts, its part in
/// comparisons, laws of calibration and dissolving cells. Reader, resolved scene, JSON Schema,
/// `explain` and docs/reference/scene_keys.md are all visitors of describe(), so no key can be
/// known to one of them and not to the others.

#include "runs/scene/scene.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Shows the visitor every key of the scene, with the scene's own fields as values.
void describe(Visitor& visitor, Scene& scene);

}  // namespace acinus::runs
