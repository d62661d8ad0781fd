#pragma once
/// Overlaps of spheres with each other and with vessels, and their limits.
///
/// The contact law of spheres holds for overlaps small against their radius. Deeper ones mean loads
/// that deformable cells would carry otherwise (docs/science/calibration.md).

#include <string>

#include "coupling/world/world.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

/// Largest acceptable overlap of two grown spheres, and of a sphere with a vessel, in radii.
inline constexpr double kSphereOverlap = 0.5, kVesselOverlap = 0.25;

/// Radius of the largest sphere at present, um; 0 without spheres.
double largest_sphere(const coupling::State& state);

/// Consequence of overlaps beyond these limits, with advice; empty if there are none.
std::string advise_sphere_overlaps(const coupling::World& world, const RunTotals& totals);

}  // namespace acinus::runs
