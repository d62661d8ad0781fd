#pragma once
/// Cell types of generated cells, drawn by region and share.

#include <cstdint>
#include <string>

#include "core/vec.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Type of a generated cell, drawn by share from the entries of cells.types whose region contains
/// its centre, or from those without a region if none does. The draw depends on seed and number
/// alone.
/// @param number  index in the order of generation
/// @param center  um
const std::string& draw_cell_type(const Scene& scene, std::int64_t number, const Vec3& center);

/// Radius of the largest type among generated cells, um.
double largest_radius(const Scene& scene);

}  // namespace acinus::runs
