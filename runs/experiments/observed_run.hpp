#pragma once
/// Series that a run has measured up to now, and values of earlier frames.

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/vec.hpp"
#include "io/checkpoint.hpp"
#include "runs/experiments/flooded_area.hpp"
#include "runs/experiments/lesion.hpp"
#include "runs/experiments/lobule_domain.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/experiments/open_area.hpp"

namespace acinus::runs {

/// Cell at the last frame.
struct CellTrack {
  Vec3 center = Vec3::Zero();  ///< um
  bool leader = false;
};

struct ObservedFrame;
struct ObservedRun;

/// Adds one number to each series of an experiment.
using Sampler = std::function<void(const ObservedFrame& frame, ObservedRun& observed)>;

/// Series so far, and the values that later frames are compared with.
struct ObservedRun {
  Measures measures;
  // Kept in checkpoints:
  std::map<std::string, double> start;  ///< values of the first frame that others are relative to
  double last_time = 0;                 ///< s, of the last frame
  std::map<std::int64_t, CellTrack> track;   ///< lineage -> the cell then
  std::array<double, kLayers + 1> births{};  ///< divisions so far by layer; the last: deeper
  // Made when first needed, from constants of the run:
  Sampler sampler;  ///< refers to devices of the world
  std::optional<LobuleDomain> lobule;
  std::optional<LesionGrid> grid;
  std::optional<FloodLattice> lattice;
};

/// Writes series and values of earlier frames to a checkpoint, and reads them back.
void put_observed_run(const ObservedRun& run, io::CheckpointData& data);
/// @throws Error(kFileError) if the checkpoint is damaged
ObservedRun get_observed_run(const io::CheckpointData& data);

}  // namespace acinus::runs
