#pragma once
/// Looks for states no tissue can be in, in the frames of a run file. Knows the scene and the file,
/// not what the run said about itself.

#include <span>
#include <vector>

#include "bench/stress/finding.hpp"
#include "bench/stress/pedigree.hpp"
#include "coupling/world/world.hpp"
#include "io/frame.hpp"
#include "io/run_reader.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::bench {

/// A cell's volume may not leave these multiples of its rest volume: cells yield to load and
/// adhesion by a factor of a few at most.
inline constexpr double kLeastVolume = 0.1, kMostVolume = 10;

/// A division halves a volume to rounding. Until the next frame neighbours and cortex may compress
/// or stretch the pair, as they may any cell, but hardly by this factor.
inline constexpr double kMostDivisionChange = 1.5;

/// - not finite: a coordinate or a cell's figures; then nothing else is looked at.
/// - inverted: a cell of non-positive volume. Crossed: a cell whose surface passes through itself.
/// - tunnelled: a deformable cell, newborn or not, deeper in a cell, wall or vessel than contact
///   points look: nothing drives such an overlap apart any more. Spheres overlap by their law;
///   between a sphere and its neighbour the limit is the sphere's centre, beyond which the force no
///   longer separates them. Sisters start in each other (coupling/measure/audit.hpp).
/// - volume: of a deformable cell, see kLeastVolume, next to its rest volume of that time; and
///   rest volumes that growth or lysis cannot have made (pedigree.hpp).
/// - lost: a centre farther from where its founder started than all active forces together could
///   have carried one cell.
/// - unborn, vanished: the cells of the frame are not those of the pedigree.
/// @param pedigree  the births and deaths up to then
std::vector<Finding> inspect_frame(const io::Frame& frame, const runs::Scene& scene,
                                   const coupling::World& start, const Pedigree& pedigree);

/// Frames and the events between them: also finds events that could not be or did not come
/// (untimely), and daughters that together have another volume than their mother had in the frame
/// before, relative to rest, by kMostDivisionChange.
/// @param start  what build_world makes of the scene
std::vector<Finding> inspect_frames(std::span<const io::Frame> frames,
                                    std::span<const io::Event> events, const runs::Scene& scene,
                                    const coupling::World& start);

/// All frames of a run file.
std::vector<Finding> inspect_run(const io::RunReader& run, const runs::Scene& scene,
                                 const coupling::World& start);

}  // namespace acinus::bench
