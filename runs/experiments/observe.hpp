#pragma once
/// What a run measures from frame to frame, and what it has to remember for that.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupling/life/life.hpp"
#include "coupling/measure/audit.hpp"
#include "io/checkpoint.hpp"
#include "io/frame.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/flooded_area.hpp"
#include "runs/experiments/lobule_room.hpp"
#include "runs/experiments/open_area.hpp"

namespace acinus::runs {

/// One written frame. The loads of this frame are assembled (take_snapshot).
struct ObservedFrame {
  const Scene& scene;
  const coupling::World& world;
  const coupling::Workspace& work;
  const Snapshot& snapshot;
  const coupling::AuditResult& audit;
};

/// Where a cell was at the last frame.
struct CellTrack {
  Vec3 center = Vec3::Zero();  ///< um
  bool leader = false;
};

struct Observables {
  Measures measures;
  // Remembered, and kept in checkpoints:
  std::map<std::string, double> start;  ///< values of the first frame that others are relative to
  double last_time = 0;                 ///< s, of the last frame
  std::map<std::int64_t, CellTrack> track;   ///< lineage -> the cell then
  std::array<double, kLayers + 1> births{};  ///< divisions so far by layer; the last: deeper
  // Made when first needed, from what does not change:
  std::optional<LobuleRoom> room;
  std::optional<LesionGrid> grid;
  std::optional<FloodLattice> lattice;
};

/// Measures a frame of the run phase: adds to all series and returns the row of /observables, time
/// first. What has no value at this frame is 0 there.
std::vector<io::SeriesValue> observe_frame(const ObservedFrame& frame, Observables& observables);

/// Why the series show all that the experiment is about, so that the run may end: cells that are
/// pulled apart have come apart. Empty: they do not.
std::string why_over(Experiment experiment, const Measures& measures);

/// Counts divisions by the layer they happened in. To be called while the daughters are where they
/// were born; does nothing unless the experiment is a lobule.
void observe_births(const Scene& scene, const coupling::World& world,
                    const coupling::LifeReport& report, Observables& observables);

void put_observables(const Observables& observables, io::CheckpointData& data);
/// @throws Error(kFileError) if the checkpoint is damaged
Observables get_observables(const io::CheckpointData& data);

}  // namespace acinus::runs
