#pragma once
/// Tissue scenes outside the calibration of a stiffness law.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::bench {

/// Scene in which a stiffness law is judged.
struct OutOfSampleScene {
  std::string name;
  runs::Scene scene;        ///< with deformable cells
  bool spheres_too = true;  ///< can be run with spheres
};

/// Size and stiffness of the cells, relative to those of calibration.json. Lengths of the scenes
/// scale with the radius.
struct OutOfSampleCells {
  double radius = 12;    ///< um
  double stiffness = 1;  ///< factor on cortex, bulk modulus and modulus of spheres
};

/// Cell type of these scenes.
runs::CellType out_of_sample_type(const OutOfSampleCells& cells);

/// Scenes: cells between approaching plates, in a box with a moving wall, in a sheared slab, in a
/// growing spheroid, in a monolayer on an adhesive plane and in a lobule.
std::vector<OutOfSampleScene> out_of_sample_scenes(const OutOfSampleCells& cells);

}  // namespace acinus::bench
