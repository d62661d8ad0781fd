#include "runs/session/sphere_overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace acinus::runs {

double largest_sphere(const coupling::World& world) {
  const coupling::State& s = world.state;
  double radius = 0;
  for (const double r : cbm::radii_at(s.cbm, s.clock.time)) radius = std::max(radius, r);
  return world.ranks.max(radius);
}

std::string advise_sphere_overlaps(const coupling::World& world, const RunTotals& totals) {
  const double radius = largest_sphere(world);
  if (radius == 0) return "";
  // Sister cells overlap by more at birth.
  const bool deep =
      world.state.divisions == 0 && totals.max_overlap_cbm_um > kSphereOverlap * radius;
  if (!deep && totals.cbm_vessel_um <= kVesselOverlap * radius) return "";
  const bool plain = std::ranges::any_of(
      world.params.cbm, [](const cbm::Params& p) { return !p.correction.corrects(); });
  return fmt::format(
      "where spheres overlap this deeply, their forces are not those of deformable cells{}",
      plain ? ". With a law they come nearer: cbm.stiffness_correction = \"auto\"" : "");
}

}  // namespace acinus::runs
