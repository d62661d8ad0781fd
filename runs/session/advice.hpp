#pragma once
/// Advice for simulations that cannot continue, limited to changes that apply to their models.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "coupling/step/controller.hpp"
#include "coupling/world/world.hpp"
#include "runs/scene/scene.hpp"
#include "runs/session/soundness.hpp"

namespace acinus::runs {

/// Overcrowded neighbourhood: the cells have more rest volume than space.
struct Crowd {
  std::int64_t cell = -1;  ///< lineage of the cell at its centre
  /// Rest volume of the cells around it relative to the volume of the neighbourhood.
  double share = 0;
};

/// Most crowded neighbourhood among those of the named cells, or of all cells if none is named;
/// empty if the cells fit. Vessel volume is not subtracted, so tissue reported as full is full.
std::optional<Crowd> find_crowd(const coupling::World& world, std::span<const std::int64_t> cells);

/// Advice for a step that fails at any step size: cause and changes that may help. Ends with a full
/// stop.
std::string advise(const coupling::World& world, const coupling::StepResult& step);

/// Advice for overlaps that contact cannot resolve.
std::string advise(const coupling::World& world, const Excess& excess);

/// Advice for a scene whose first frame has such overlaps.
std::string advise_start(const Scene& scene, const coupling::World& world, const Excess& excess);

}  // namespace acinus::runs
