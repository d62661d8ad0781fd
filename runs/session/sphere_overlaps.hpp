#pragma once
/// Overlaps of spheres with each other and with vessels, and their limits.
///
/// The contact law of spheres holds for overlaps small against their radius. Deeper ones mean loads
/// that deformable cells would carry otherwise (docs/science/calibration.md).

#include <string>

#include "coupling/world/world.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

/// Largest acceptable overlap of two grown spheres, and of a sphere with a vessel, in radii: as far
/// as the centres of deformable cells come closer than their radii at rest in the lobule of the
/// shipped scene lobule_dcm (0.50 and 0.38 radii).
inline constexpr double kSphereOverlap = 0.5, kVesselOverlap = 0.4;

/// Radius of the largest sphere at present, um; 0 without spheres. Collective.
double largest_sphere(const coupling::World& world);

/// Consequence of overlaps beyond these limits, with advice; empty if there are none. Collective.
std::string advise_sphere_overlaps(const coupling::World& world, const RunTotals& totals);

}  // namespace acinus::runs
