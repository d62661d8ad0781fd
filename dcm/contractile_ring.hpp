#pragma once
/// Distribution of the active tension of a cortex over the surface.

#include "core/vec.hpp"

namespace acinus::dcm {

/// The tension T of a type becomes T (1 + excess exp(-c^2 / (2 width^2))), c the cosine of the
/// angle between the axis and the way from the cell's centre to the place: a band about the equator
/// that pulls harder. The axis is fixed in space: it does not turn with the cell.
struct ContractileRing {
  double excess = 0;          ///< tension of the band beyond that of the poles, over the latter
  double width = 0.2;         ///< of the band, in cell radii along the axis
  Vec3 axis = Vec3::UnitZ();  ///< any length > 0
};

}  // namespace acinus::dcm
