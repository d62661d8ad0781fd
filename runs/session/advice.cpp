#include "runs/session/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "coupling/life/density.hpp"
#include "coupling/world/cell.hpp"
#include "runs/assemble/placing_advice.hpp"

namespace acinus::runs {
namespace {

/// Advice for overcrowded tissue; empty if the cells fit.
std::string advise_if_full(const coupling::World& world, std::span<const std::int64_t> cells) {
  const std::optional<Crowd> crowd = find_crowd(world, cells);
  if (!crowd) return {};
  std::string text = fmt::format(
      "The tissue is full: the cells within {:.0f} um of cell {} have {:.2f} times the volume of "
      "that space at rest. ",
      coupling::kDensityReach, crowd->cell, crowd->share);
  const bool grows = std::ranges::any_of(world.params.life.type,
                                         [](const coupling::CycleParams& c) { return c.time > 0; });
  text += grows ? "Let fewer cells grow (life.proliferation.cells, inhibition by pressure or "
                  "density, rules that rest), enlarge the space around the cells, or end earlier."
                : "Start with fewer or smaller cells, enlarge the space around them, or end its "
                  "compression "
                  "earlier.";
  return text;
}

bool has_shells(const coupling::World& world) { return !world.state.dcm.group.empty(); }

}  // namespace

std::optional<Crowd> find_crowd(const coupling::World& world, std::span<const std::int64_t> cells) {
  const coupling::State& s = world.state;
  const std::vector<double> share = coupling::local_volume_shares(world);
  Crowd worst;
  coupling::for_each_cell(s, [&](const coupling::Cell& c) {
    const std::int64_t id = coupling::lineage_of(s, c);
    const bool named = cells.empty() || std::ranges::find(cells, id) != cells.end();
    if (named && share[c.index] > worst.share) worst = {id, share[c.index]};
  });
  return worst.share > 1 ? std::optional(worst) : std::nullopt;
}

std::string advise(const coupling::World& world, const coupling::StepResult& step) {
  if (std::string full = advise_if_full(world, step.cells); !full.empty()) return full;
  if (!has_shells(world))
    return "Try a smaller load or adhesion, stiffer spheres (cbm.young), a smaller time.min_step, "
           "or for a solve that does not converge a larger solver.max_iterations.";
  return "Try a larger contact.repulsion, a smaller load or adhesion, a smaller time.min_step, for "
         "a face that turns over a local_area_modulus, which keeps meshes regular, or for a solve "
         "that does not converge a larger solver.max_iterations.";
}

std::string advise(const coupling::World& world, const Excess& excess) {
  if (std::string full = advise_if_full(world, excess.cells); !full.empty()) return full;
  const bool corrected = std::ranges::any_of(
      world.params.cbm, [](const cbm::Params& p) { return p.correction.corrects(); });
  if (!has_shells(world) && corrected)
    return "Calibrated spheres are stiff where they are crowded and cannot pass where deformable "
           "cells can: take fewer cells, fewer vessels, spheres without cbm.stiffness_correction, "
           "or deformable cells there (zoom).";
  if (!has_shells(world))
    return "Start the cells farther apart or small (start_up), make them stiffer (cbm.young, "
           "cbm.stiffness_correction), or lower load or adhesion.";
  return "Start the cells farther apart or small (start_up), raise contact.max_depth or "
         "contact.repulsion, take a finer mesh, or lower load or adhesion.";
}

std::string advise_start(const Scene& scene, const coupling::World& world, const Excess& excess) {
  if (scene.start_up.enabled) return advise(world, excess);
  std::vector<std::string> ways = list_smaller_starts(scene);
  constexpr std::size_t kPair = 2;
  ways.push_back(excess.cells.size() == kPair ? advise_spacing(scene)
                                              : "place them elsewhere or take smaller ones");
  return fmt::format("{}.", fmt::join(ways, ", or "));
}

}  // namespace acinus::runs
