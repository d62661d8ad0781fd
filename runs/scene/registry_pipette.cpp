#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

constexpr Key kSuctionThen{.name = "pressure",
                           .meaning = "suction then, below the pressure outside",
                           .dimension = kStress,
                           .unit = "Pa",
                           .range = kNotNegative,
                           .symbol = "dp",
                           .required = true};

}  // namespace

void describe_pipette(Visitor& v, PipetteBlock& b) {
  v.vector({.name = "mouth",
            .meaning = "centre of the plane in which the tube begins",
            .dimension = kLength,
            .unit = "um"},
           b.mouth);
  v.vector({.name = "axis", .meaning = "direction from the mouth into the tube"}, b.axis);
  v.real({.name = "radius",
          .meaning = "inner radius",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_p",
          .required = true},
         b.radius);
  v.real({.name = "thickness",
          .meaning = "thickness of the wall",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.thickness);
  v.real({.name = "lip",
          .meaning = "radius with which the edges at both ends are rounded",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.lip);
  v.real({.name = "length",
          .meaning = "length along the axis",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.length);
  blocks(v, {.name = "suction", .meaning = "suction over time; none = 0 Pa", .item = "suction"},
         b.suction.entry, describe_course_point<kSuctionThen>);
}

}  // namespace acinus::runs
