#pragma once
/// Report of events between two steps: divisions, deaths, mesh repair, changes of model.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/life/division.hpp"
#include "coupling/world/event_kind.hpp"

namespace acinus::coupling {

/// Event of life or of the zoom, for the run file.
struct LifeEvent {
  EventKind kind{};
  std::vector<std::int64_t> cells;  ///< lineages; division: mother, daughter, daughter
  std::string message;
};

/// Report of the events between two steps.
struct LifeReport {
  std::vector<LifeEvent> events;
  std::vector<DivisionFigures> divisions;  ///< of deformable cells
  /// True if the process was asked to stop: started events are undone and Clock::due has the
  /// pending ones. Call live() again before the next step.
  bool interrupted = false;
};

}  // namespace acinus::coupling
