#pragma once
/// Compression of a clump of cells, the scene of a calibration.

#include <cstdint>
#include <string>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Options of the compressed clump.
struct ClumpOptions {
  std::string type;  ///< cell type; empty = the only type of the scene
  int cells = 0;     ///< number of cells; 0: as in the scene, 59 without a clump there
  double rate = 1;   ///< factor on the compression rate
};

/// Name of the cell type to calibrate.
/// @throws Error if the scene has several types and none is named
std::string choose_type(const Scene& scene, const std::string& type);

/// Scene of a body-centred clump of deformable cells of one type, without motility, in a capsule
/// that shrinks until neighbours overlap by a fifth of their diameters. A scene that is such an
/// experiment stays as it is unless other cells or another rate are asked for; of any other scene
/// it takes cell type, contact, friction and seed.
Scene compression_scene(const Scene& scene, const ClumpOptions& options);

/// Scene of two of its cells that touch and adhere, for as long as they take to come to rest.
Scene pair_scene(const Scene& compression);

/// Scene of two of its cells in a liquid that adhere and are then pulled apart by a force that
/// rises slowly to six times that of vesicles, pi W R^.   @param seed  of the orientations of both
/// meshes
Scene pull_scene(const Scene& compression, std::uint64_t seed);

/// Scene of two layers of twelve of its cells between mirror walls, pulled past each other with a
/// shear stress of some 2 Pa, that of the pull of a cell that leads others.
Scene sliding_scene(const Scene& compression);

/// Scene of the same cells as spheres of one modulus.
/// @param law_file  stiffness law, or "none"
Scene as_spheres(const Scene& compression, const std::string& law_file);

}  // namespace acinus::runs
