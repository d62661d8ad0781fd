#pragma once
/// Frame of the start of a scene, before its first step.

#include <string>
#include <vector>

#include "io/frame.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Start of a scene as a picture.
struct StartFrame {
  io::Frame frame;  ///< its tables have no loads; cells that a start-up would grow have full size
  int deformable = 0, spheres = 0;  ///< cells
  double vessel_length = 0;         ///< um
  Notes notes;                      ///< on the construction of the world
};

/// Places the cells of a scene without a start-up.
/// @throws Error for geometry that does not fit, as build_world()
StartFrame make_start_frame(const Scene& scene);

}  // namespace acinus::runs
