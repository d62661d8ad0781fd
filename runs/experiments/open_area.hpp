#pragma once
/// Uncovered area and front of the lesion by rays from the vein axis.

#include <cstdint>
#include <vector>

#include "core/box.hpp"
#include "geometry/network.hpp"
#include "runs/experiments/lobule_domain.hpp"
#include "runs/experiments/sections.hpp"

namespace acinus::runs {

/// Points on rays from the axis inside the initial lesion, at equal angles and heights.
struct LesionGrid {
  Vec3 axis = Vec3::Zero();
  double from_radius = 0, to_radius = 0;  ///< um, the vein's and the initial lesion's
  double cap = 0;                         ///< um, a ray ends here if it meets no cell
  double angle_step = 0, radius_step = 0;
  std::vector<double> height;      ///< um, of the slices
  std::vector<Vec2> ray;           ///< unit
  int n_radius = 0;                ///< points on a ray
  std::vector<std::uint8_t> free;  ///< [slice][ray][point] 1: not in a vessel
};

/// Grid of the initial lesion: one ray a degree, one slice every 4 um, one point every 2 um.
/// @param lesion_radius  um, of the initial lesion
LesionGrid make_lesion_grid(const LobuleDomain& lobule, double lesion_radius,
                            const geometry::Network& vessels);

/// Boxes that hold the segments of vessels, um.
std::vector<Box> segment_boxes(const geometry::Network& vessels);

/// Open area and front of a frame.
struct Opening {
  double area = 0;       ///< um^2, outside vessels, covered by no cell; mean over height
  double seen = 0;       ///< um^2, up to the first cell surface; mean over height
  double front = 0;      ///< um, mean distance to the first cell surface, at most the cap
  double roughness = 0;  ///< um, its standard deviation over angle and height
};

/// Open area and front.
/// @param sections  at the heights of the grid
Opening measure_opening(const LesionGrid& grid, const std::vector<Section>& sections);

}  // namespace acinus::runs
