#include "runs/session/sphere_overlaps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace acinus::runs {

double largest_sphere(const coupling::State& state) {
  double radius = 0;
  for (const double r : cbm::radii_at(state.cbm, state.clock.time)) radius = std::max(radius, r);
  return radius;
}

std::string describe_sphere_overlaps(const coupling::World& world, const RunTotals& totals) {
  const double radius = largest_sphere(world.state);
  if (radius == 0) return "";
  std::vector<std::string> deep;
  // Sister cells overlap by more at birth.
  if (world.state.divisions == 0 && totals.max_overlap_cbm_um > kSphereOverlap * radius)
    deep.push_back(fmt::format("overlap by up to {:.2g} um", totals.max_overlap_cbm_um));
  if (totals.cbm_vessel_um > kVesselOverlap * radius)
    deep.push_back(fmt::format("reach up to {:.2g} um into vessels", totals.cbm_vessel_um));
  if (deep.empty()) return "";
  const bool plain = std::ranges::any_of(
      world.params.cbm, [](const cbm::Params& p) { return !p.correction.corrects(); });
  return fmt::format(
      "spheres of radius {:.3g} um {}: their loads there are not those of deformable "
      "cells{}",
      radius, fmt::join(deep, " and "),
      plain ? ". With a law they are nearer: cbm.stiffness_correction = \"auto\"" : "");
}

}  // namespace acinus::runs
