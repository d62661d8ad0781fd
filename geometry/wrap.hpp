#pragma once
/// Closed surface round one that has holes, crosses itself or is in pieces.

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Shrinks a ball onto a triangle surface down to the distance `offset`, um; it enters no hole
/// narrower than about `alpha`, um [Portaneri2022]. Always closed, a manifold, without
/// self-intersection, and larger than the given surface by the offset. Inner walls vanish.
/// @pre alpha > 0, offset > 0
Surface wrap(const Surface& surface, double alpha, double offset);

}  // namespace acinus::geometry
