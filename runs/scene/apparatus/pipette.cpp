#include <fmt/format.h>

#include <algorithm>

#include "coupling/apparatus/suction/suction.hpp"
#include "runs/scene/apparatus/device_block.hpp"
#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/registry_blocks.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

constexpr Key kSuctionThen{.name = "pressure",
                           .meaning = "suction then, below the pressure outside",
                           .dimension = kStress,
                           .unit = "Pa",
                           .range = kNotNegative,
                           .symbol = "dp",
                           .required = true};

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

void describe_pipette_block(Visitor& v, Scene& s) {
  optional_block(
      v,
      {.name = "pipette",
       .meaning = "rigid tube that may suck at deformable cells, or a hole that cells go "
                  "through; null = none"},
      s.pipette, describe_pipette);
}

void check_tube(const PipetteBlock& p, Report& report) {
  if (!(p.axis.norm() > 0)) report.add_relation({"/pipette/axis"}, "[0, 0, 0]", "has no direction");
  for (const auto& [key, size] : {std::pair("thickness", p.thickness), {"length", p.length}})
    if (p.lip > size / 2)
      report.add_relation(
          {"/pipette/lip", std::string("/pipette/") + key}, quoted_length(p.lip),
          fmt::format("must be at most half of /pipette/{} = {}", key, quoted_length(size)));
}

void check_suction(const Scene& scene, const PipetteBlock& p, Report& report) {
  check_course(p.suction, "/pipette/suction", report);
  if (!has_suction(p)) return;
  if (model_of(scene) == CellModel::kCbm)
    report.add_relation({"/pipette/suction", "/cells/model"}, "",
                        "is for deformable cells: set /cells/model to \"dcm\"");
  if (scene.life.sleep)
    report.add_relation({"/pipette/suction", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

void check_pipette(const Scene& scene, Report& report) {
  if (!scene.pipette) return;
  check_tube(*scene.pipette, report);
  check_suction(scene, *scene.pipette, report);
}

/// Adds suction; the tube is a wall and is built with the boundary.
void add_suction(const Scene& scene, coupling::Params& params) {
  if (!scene.pipette || scene.pipette->suction.entry.empty()) return;
  const PipetteBlock& p = *scene.pipette;
  coupling::Suction suction;
  suction.mouth = p.mouth;
  suction.axis = p.axis.normalized();
  suction.reach = p.radius + 0.5 * p.thickness;
  suction.pressure = p.suction;
  params.apparatus.add(std::move(suction));
}

}  // namespace

bool has_suction(const PipetteBlock& p) {
  return std::ranges::any_of(p.suction.entry, [](const auto& e) { return e.value > 0; });
}

const DeviceBlock kPipetteBlock{"pipette", describe_pipette_block, check_pipette, add_suction};

}  // namespace acinus::runs
