#pragma once
/// The clump that calibration compresses, as a scene.

#include <string>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

struct ClumpOptions {
  std::string type;  ///< cell type; empty = the scene's only one
  int cells = 0;     ///< 0: as in the scene, 59 if it has no clump
  double rate = 1;   ///< factor on the speed of compressing
};

/// Name of the cell type meant. @throws Error if the scene has several and none is named
std::string choose_type(const Scene& scene, const std::string& type);

/// A body-centred clump of deformable cells of one type in a capsule that shrinks until neighbours
/// overlap by a fifth of their diameters, without motility. A scene that is such an experiment
/// itself stays as it is unless other cells or another rate are asked for; of any other scene it
/// has the cell type, contact, friction and seed.
Scene compression_scene(const Scene& scene, const ClumpOptions& options);

/// The same clump as spheres of one modulus, with a law file or "none".
Scene as_spheres(const Scene& compression, const std::string& law_file);

}  // namespace acinus::runs
