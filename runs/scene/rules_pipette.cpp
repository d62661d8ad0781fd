#include <fmt/format.h>

#include <algorithm>

#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

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
  if (scene.model.value_or(scene.cells.model) == CellModel::kCbm)
    report.add_relation({"/pipette/suction", "/cells/model"}, "",
                        "is for deformable cells: set /cells/model to \"dcm\"");
  if (scene.life.sleep)
    report.add_relation({"/pipette/suction", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

}  // namespace

bool has_suction(const PipetteBlock& p) {
  return std::ranges::any_of(p.suction.entry, [](const auto& e) { return e.value > 0; });
}

void check_pipette(const Scene& scene, Report& report) {
  if (!scene.pipette) return;
  check_tube(*scene.pipette, report);
  check_suction(scene, *scene.pipette, report);
}

}  // namespace acinus::runs
