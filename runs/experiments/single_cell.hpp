#pragma once
/// Measurements and rules that experiments on single deformable cells share.

#include <limits>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "coupling/world/world.hpp"
#include "runs/scene/fault_report.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Value of an observable in a frame without the cells it is measured on.
inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Nodes of the first deformable cell; empty if there is none.
std::vector<Vec3> first_cell(const coupling::World& world);

/// Extent of points along a direction, and the mean over 36 directions across an axis, um.
double extent(std::span<const Vec3> points, const Vec3& direction);
double extent_across(std::span<const Vec3> points, const Vec3& axis);

/// Rule of experiments on one cell: the scene lists one, and it is deformable.
void check_one_deformable_cell(const Scene& scene, Report& report);

/// Rules of experiments on one cell at a pipette that is narrower than the cell.
/// @return true if the scene has a pipette
bool check_pipette_experiment(const Scene& scene, Report& report);

}  // namespace acinus::runs
