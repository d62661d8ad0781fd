#pragma once
/// Lesion round the central vein by the radius of its edge.
///
/// Lesion radius: "the average distance from the central vein to the closest cell in every layer
/// whereby we consider the 3 closest layers to the lesion" [VanLiedekerke2020, footnote 11]. Layers
/// can be slices of height or rings, distances those of centres or surfaces; all four are measured.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "contact/surface.hpp"
#include "core/vec.hpp"

namespace acinus::runs {

/// Layers that are counted one by one; deeper ones are counted together.
inline constexpr int kLayers = 6;

/// Definition of the radius of the lesion.
struct LesionReading {
  std::string name;     ///< slices_centre, slices_surface, rings_centre, rings_surface
  std::string meaning;  ///< of its layers and distances
  bool rings = false, surface = false;
};
const std::array<LesionReading, 4>& lesion_readings();

/// Place of a cell relative to the lesion.
struct LesionCell {
  double height = 0;   ///< um, of the centre above the foot of the lobule
  double center = 0;   ///< um, horizontal distance of the centre from the vein axis
  double surface = 0;  ///< um, that of the nearest point of its surface
  int layer = 1;       ///< coupling::compute_layers
};

/// Sizes that do not change through a run, um.
struct LesionFrame {
  double height = 48;       ///< of the lobule
  double vein_radius = 10;  ///< of the central vein
  double cell_radius = 12;  ///< at rest
};

/// Mean over the layers that have cells of the distance to the closest cell in it; 0 if none has.
/// Slices: equal ones, about one cell diameter high, and a cell is in that of its centre. Rings:
/// the first three layers behind the edge.
double lesion_radius(std::span<const LesionCell> cells, const LesionFrame& frame,
                     const LesionReading& reading);

/// Radius when cells have reached the vein: that of the vein, by centres that of a cell
/// beside it, by rings one cell diameter more, since the second and third lie so much farther out.
double lesion_floor(const LesionFrame& frame, const LesionReading& reading);

/// Relative area ((r - floor) / (r0 - floor))^2, differences below 0 taken as 0; 0 if r0 is not
/// above the floor.
double relative_area(double radius, double first, double floor);

/// Horizontal distance from a vertical axis to the nearest point of a surface, um. Exact where the
/// axis does not run through the body.
double surface_distance(const contact::SurfaceBody& body, const Vec3& axis_point);

}  // namespace acinus::runs
