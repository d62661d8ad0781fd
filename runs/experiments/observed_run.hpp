#pragma once
/// The series that a run has measured up to now, and its memory of earlier frames.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/vec.hpp"
#include "io/checkpoint.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/flooded_area.hpp"
#include "runs/experiments/lesion.hpp"
#include "runs/experiments/lobule_room.hpp"
#include "runs/experiments/open_area.hpp"

namespace acinus::runs {

/// A cell at the last frame.
struct CellTrack {
  Vec3 center = Vec3::Zero();  ///< um
  bool leader = false;
};

/// The series so far, and what the next frame is compared with.
struct ObservedRun {
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

/// Writes what is remembered to a checkpoint, and reads it back.
void put_observed_run(const ObservedRun& run, io::CheckpointData& data);
/// @throws Error(kFileError) if the checkpoint is damaged
ObservedRun get_observed_run(const io::CheckpointData& data);

}  // namespace acinus::runs
