#pragma once
/// What to change when a simulation cannot continue: advice that can work for the models there are.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "coupling/step/controller.hpp"
#include "coupling/world/world.hpp"
#include "runs/scene/scene.hpp"
#include "runs/session/soundness.hpp"

namespace acinus::runs {

/// A place where cells have more volume at rest than there is room.
struct Crowd {
  std::int64_t cell = -1;  ///< lineage, in the middle of it
  double share = 0;        ///< volume at rest of the cells around it over the volume of that space
};

/// The most crowded place among the cells named, or among all if none is; nothing where cells still
/// fit. Room taken by vessels is not taken off, so tissue called full is full.
std::optional<Crowd> find_crowd(const coupling::World& world, std::span<const std::int64_t> cells);

/// Why a step failed at any length and what may help; ends with a full stop.
std::string advise(const coupling::World& world, const coupling::StepResult& step);

/// The same for overlaps that contact cannot mend.
std::string advise(const coupling::World& world, const Excess& excess);

/// What to change in the scene when its first frame already has such overlaps.
std::string advise_start(const Scene& scene, const coupling::World& world, const Excess& excess);

}  // namespace acinus::runs
