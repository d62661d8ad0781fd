#pragma once
/// Of which type the cells are that a scene does not list one by one.

#include <cstdint>
#include <string>

#include "core/vec.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Type of a generated cell with this number and place: one of those that cells.types has for the
/// regions it is in, or for anywhere if it is in none, drawn by their shares. A cell's draw depends
/// on the seed and its number alone.
const std::string& type_of_generated(const Scene& scene, std::int64_t number, const Vec3& center);

/// Radius of the largest type that a generated cell may be of, um.
double largest_radius(const Scene& scene);

}  // namespace acinus::runs
