#pragma once
/// Situations in which a law of stiffness is judged: tissue that it was not found in.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::bench {

struct OutOfSampleScene {
  std::string name;
  runs::Scene scene;        ///< deformable cells
  bool spheres_too = true;  ///< whether spheres can be run in it by themselves
};

/// The cells of the scene calibration.json, of another size and stiffness where asked for: all
/// lengths of the scenes go with the radius.
struct OutOfSampleCells {
  double radius = 12;    ///< um
  double stiffness = 1;  ///< factor on cortex, bulk modulus and modulus of spheres
};

/// That cell type.
runs::CellType out_of_sample_type(const OutOfSampleCells& cells);

/// Cells between plates that close in, in a box with one wall that comes nearer, in a slab that is
/// sheared, in a growing spheroid, in a monolayer on an adhesive plane and in a lobule.
std::vector<OutOfSampleScene> out_of_sample_scenes(const OutOfSampleCells& cells);

}  // namespace acinus::bench
