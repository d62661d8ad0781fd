#pragma once
/// A closed surface about one that has holes, crosses itself or is in pieces.

#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Shrinks a ball onto a triangle surface until it is `offset` away from it, um; it enters no hole
/// narrower than about `alpha`, um [Portaneri2022]. Always closed, a manifold, without
/// self-intersection; as much larger than the surface given as the offset says. Inner walls vanish.
/// @pre alpha > 0, offset > 0
Surface wrap(const Surface& surface, double alpha, double offset);

}  // namespace acinus::geometry
