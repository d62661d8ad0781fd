#pragma once
/// Detection of physically impossible states in the frames of a run file, from scene and file
/// alone, independent of the run's own reports.

#include <span>
#include <vector>

#include "bench/stress/finding.hpp"
#include "bench/stress/pedigree.hpp"
#include "coupling/world/world.hpp"
#include "io/frame.hpp"
#include "io/run_reader.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::bench {

/// Bounds of volume over rest volume of a cell; load and adhesion change it by a small factor only.
inline constexpr double kLeastVolume = 0.1, kMostVolume = 10;

/// Largest factor between the relative volumes of a mother and of her daughters in the next frame.
/// Division halves a volume exactly; in between the pair may be compressed or stretched like any
/// cell.
inline constexpr double kMostDivisionChange = 1.5;

/// Inspects one frame for these defects:
/// - not finite: a coordinate or figure of a cell; ends the inspection.
/// - inverted: cell of non-positive volume. Crossed: cell with a self-intersecting surface.
/// - tunnelled: deformable cell deeper in a cell, wall or vessel than contact searches, so that
///   nothing separates them. For spheres the limit is their centre, beyond which forces no longer
///   separate them. Sisters start in each other (coupling/measure/audit.hpp).
/// - volume: relative volume of a deformable cell outside kLeastVolume to kMostVolume, or a rest
///   volume impossible by growth or lysis (pedigree.hpp).
/// - lost: cell farther from the start of its founder than active forces can carry it.
/// - unborn, vanished: cells that differ from those of the pedigree.
/// @param pedigree  births and deaths so far
std::vector<Finding> inspect_frame(const io::Frame& frame, const runs::Scene& scene,
                                   const coupling::World& start, const Pedigree& pedigree);

/// Inspects frames and the events between them. Also finds untimely events, and daughters whose
/// relative volume differs from that of their mother in the frame before by more than
/// kMostDivisionChange.
/// @param start  of build_world(scene)
std::vector<Finding> inspect_frames(std::span<const io::Frame> frames,
                                    std::span<const io::Event> events, const runs::Scene& scene,
                                    const coupling::World& start);

/// Inspects all frames of a run file.
std::vector<Finding> inspect_run(const io::RunReader& run, const runs::Scene& scene,
                                 const coupling::World& start);

}  // namespace acinus::bench
