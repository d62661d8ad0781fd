#pragma once
/// How the active tension of a cortex varies over time and over the surface.

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"

namespace acinus::dcm {

/// The tension T of a type becomes T f(t) (1 + ring exp(-c^2 / (2 width^2))), c the cosine of the
/// angle between the axis and the way from the cell's centre to the place: a band about the equator
/// that pulls harder. The axis is fixed in space: it does not turn with the cell.
struct Contraction {
  Schedule course;            ///< factor f over s since t = 0; empty: 1
  double ring = 0;            ///< tension of the band beyond that of the poles, over the latter
  double width = 0.2;         ///< of the band, in cell radii along the axis
  Vec3 axis = Vec3::UnitZ();  ///< any length > 0
};

/// The factor f at a time, s since t = 0.
inline double contraction_factor(const Contraction& c, double time) {
  return c.course.entry.empty() ? 1 : c.course.at(time);
}

}  // namespace acinus::dcm
