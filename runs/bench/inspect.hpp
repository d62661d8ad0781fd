#pragma once
/// Looks for states no tissue can be in, in the frames of a run file. Knows the scene and the file,
/// not what the run said about itself.

#include <string>
#include <vector>

#include "core/io/frame.hpp"
#include "core/io/run_reader.hpp"
#include "coupling/world.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

enum class Defect { kNotFinite, kInverted, kCrossed, kTunnelled, kVolume, kLost };
const char* name_of(Defect defect);

/// One thing wrong with one frame.
struct Finding {
  Defect defect = Defect::kNotFinite;
  double time_s = 0;
  std::string what;  ///< which cells, how much
};

/// A cell's volume may not leave these multiples of its rest volume: cells yield to load and
/// adhesion by a factor of a few at most.
inline constexpr double kLeastVolume = 0.1, kMostVolume = 10;

/// - not finite: a coordinate or a cell's figures; then nothing else is looked at.
/// - inverted: a cell of non-positive volume. Crossed: a cell whose surface passes through itself.
/// - tunnelled: a deformable cell beyond deepest_overlap() in a cell, wall or vessel: contact
/// points
///   look no deeper, so nothing drives such an overlap apart any more. Spheres overlap by their
///   law; between a sphere and its neighbour the limit is the sphere's centre, beyond which the
///   force no longer separates them.
/// - volume: of a deformable cell, see kLeastVolume.
/// - lost: a centre farther from where it started than all active forces together could have
///   carried one cell.
/// @param start  what build_world makes of the scene
std::vector<Finding> inspect_frame(const io::Frame& frame, const Scene& scene,
                                   const coupling::World& start);

/// All frames of a run file.
std::vector<Finding> inspect_run(const io::RunReader& run, const Scene& scene,
                                 const coupling::World& start);

}  // namespace acinus::runs
