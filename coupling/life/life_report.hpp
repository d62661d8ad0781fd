#pragma once
/// Events between two steps: divisions, deaths, better meshes, changes of model.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/life/division.hpp"
#include "coupling/world/event_kind.hpp"

namespace acinus::coupling {

/// One event of life or of the zoom, for the run file.
struct LifeEvent {
  EventKind kind{};
  std::vector<std::int64_t> cells;  ///< of a division: mother, daughter, daughter
  std::string message;
};

/// Events between two steps.
struct LifeReport {
  std::vector<LifeEvent> events;
  std::vector<DivisionFigures> divisions;  ///< of deformable cells
  /// The process was asked to stop meanwhile: what was begun is undone, Clock::due says what is
  /// left to do. live() is to be called again before the next step.
  bool interrupted = false;
};

}  // namespace acinus::coupling
