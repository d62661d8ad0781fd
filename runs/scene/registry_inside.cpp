/// Registry: nucleus and contraction of a deformable cell.

#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

constexpr Key kFactorThen{
    .name = "factor", .meaning = "factor then", .range = kNotNegative, .required = true};

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

void describe_contraction(Visitor& v, dcm::Contraction& b) {
  blocks(v,
         {.name = "course",
          .meaning = "factor on cortex_tension over time; none = 1",
          .item = "contraction"},
         b.course.entry, describe_course_point<kFactorThen>);
  v.real({.name = "ring",
          .meaning = "tension of a band about the equator beyond that of the poles, over the "
                     "latter; 0 = no band",
          .range = kNotNegative},
         b.ring);
  v.real({.name = "width",
          .meaning = "width of the band along the axis in cell radii: the standard deviation of a "
                     "Gaussian",
          .range = kPositive},
         b.width);
  v.vector({.name = "axis",
            .meaning = "direction from pole to pole, fixed in space: it does not turn with the "
                       "cell"},
           b.axis);
}

}  // namespace acinus::runs
