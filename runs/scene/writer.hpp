#pragma once
/// Writes a scene back as JSON with every default filled in.

#include <string>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Scene as canonical JSON: registry order, every key, quantities in their preferred units with
/// the digits that give the same doubles again, file names absolute. Reading it gives the same
/// scene.
std::string write_resolved(const Scene& scene);

/// XXH64 of the canonical JSON, 16 hexadecimal digits. Files enter with their names only, so that a
/// scene keeps its hash when it is moved to another folder or machine.
std::string hash_scene(const Scene& scene);

/// Renews resolved_json and hash. Call after the last change to a scene.
void set_canonical(Scene& scene);

}  // namespace acinus::runs
