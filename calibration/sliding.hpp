#pragma once
/// Two layers of cells that slide past each other under a constant shear stress, as a measure of
/// the friction that spheres need to stand in for deformable cells.
///
/// Deformable cells roll and their surfaces go along with their neighbours; spheres have no
/// rotation, and the friction per area of their contacts acts on the whole difference of the
/// velocities of their centres. With the same coefficient their layers slide several times slower.

#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::calibration {

/// Distance that the upper layer slides over the lower one.
struct Slide {
  std::vector<double> time;  ///< s
  std::vector<double> slid;  ///< um
};

/// Distance along x between the mean centres of the upper and the lower half of the cells, um.
/// @param first  centres in the first frame, which tell the layers
/// @param now    centres of the same cells
double offset_of_layers(std::span<const Vec3> first, std::span<const Vec3> now);

/// Distance slid in the last two thirds of the time, um: at first deformable cells shear.
/// 0 if there is none.
double steady_slide(const Slide& slide);

}  // namespace acinus::calibration
