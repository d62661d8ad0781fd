/// Registry: nucleus and contraction of a deformable cell.

#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_nucleus_shell(Visitor& v, dcm::Nucleus& b) {
  v.real({.name = "young",
          .meaning = "Young's modulus of its shell",
          .dimension = kStress,
          .unit = "kPa",
          .range = kNotNegative},
         b.young);
  v.real({.name = "thickness",
          .meaning = "thickness of its shell",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.thickness);
  v.real({.name = "poisson",
          .meaning = "Poisson ratio of its shell",
          .range = {.low = 0, .high = 0.5}},
         b.poisson);
  v.real({.name = "area_modulus",
          .meaning = "resistance of its whole surface to area change",
          .dimension = kTension,
          .unit = "N/m",
          .range = kNotNegative},
         b.area_modulus);
  v.real({.name = "bulk_modulus",
          .meaning = "resistance to volume change. With this, young, area_modulus, link_young and "
                     "link_friction 0 the nucleus has no effect and is left out",
          .dimension = kStress,
          .unit = "Pa",
          .range = kNotNegative},
         b.bulk_modulus);
}

}  // namespace

void describe_nucleus(Visitor& v, dcm::Nucleus& b) {
  v.integer({.name = "nodes",
             .meaning = "nodes of its surface mesh, not more than those of the cell",
             .choices = "42|92|162|252|362|642|1442|2562"},
            b.nodes);
  v.real({.name = "size",
          .meaning = "radius at rest over that of the cell; its volume keeps its share as the cell "
                     "grows",
          .range = {.low = 0.1, .high = 0.9}},
         b.size);
  describe_nucleus_shell(v, b);
  v.real({.name = "friction",
          .meaning = "friction with the cytosol, per area of the nucleus",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kPositive},
         b.friction);
  v.real({.name = "repulsion",
          .meaning = "stiffness of its contact with the cortex, per area",
          .dimension = kStiffnessPerArea,
          .unit = "kPa/um",
          .range = kPositive},
         b.repulsion);
  v.real({.name = "gap",
          .meaning = "distance from the cortex at which that contact begins",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.gap);
  v.real({.name = "link_young",
          .meaning = "Young's modulus of the cytoskeleton between nucleus and cortex; 0 = none",
          .dimension = kStress,
          .unit = "kPa",
          .range = kNotNegative},
         b.link_young);
  v.real({.name = "link_friction",
          .meaning = "viscosity beside that modulus (Kelvin and Voigt)",
          .dimension = kViscosity,
          .unit = "Pa s",
          .range = kNotNegative},
         b.link_friction);
}

}  // namespace acinus::runs
