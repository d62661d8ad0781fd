#pragma once
/// Distribution of the active tension of a cortex over the surface.

#include "core/vec.hpp"

namespace acinus::dcm {

/// Contractile ring: the tension T of a type becomes T (1 + excess exp(-c^2 / (2 width^2))), c the
/// cosine of the angle between the axis and the direction from the cell's centre. It is a band of
/// higher tension about the equator. The axis is fixed in space: it does not turn with the cell.
struct ContractileRing {
  double excess = 0;          ///< tension of the band beyond that of the poles, over the latter
  double width = 0.2;         ///< of the band, in cell radii along the axis
  Vec3 axis = Vec3::UnitZ();  ///< any length > 0
};

}  // namespace acinus::dcm
