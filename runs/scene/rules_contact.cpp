#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dcm/contact/contact_params.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// True if the scene may have spheres.
bool has_spheres(const Scene& scene) {
  if (scene.model.value_or(scene.cells.model) != CellModel::kDcm) return true;
  return scene.cells.source == CellSource::kList &&
         std::ranges::any_of(scene.cells.list, [](const CellEntry& c) {
           return c.model.value_or(CellModel::kDcm) != CellModel::kDcm;
         });
}

/// Checks that nothing stands around the cells: obstacles act by another law, so that such a scene
/// would compare nothing.
void check_alone(const Scene& scene, const std::string& law, Report& report) {
  const std::pair<const char*, bool> around[] = {{"/lobule", scene.lobule.has_value()},
                                                 {"/vessels/file", !scene.vessels.file.empty()},
                                                 {"/walls", !scene.walls.empty()},
                                                 {"/capsule", scene.capsule.enabled},
                                                 {"/static_meshes", !scene.static_meshes.empty()},
                                                 {"/pipette", scene.pipette.has_value()}};
  for (const auto& [pointer, exists] : around)
    if (exists)
      report.add_relation({"/contact/law", pointer}, law,
                          fmt::format("is for deformable cells with nothing around them. Remove "
                                      "{}, or choose \"cohesive\"",
                                      pointer));
  if (has_spheres(scene))
    report.add_relation({"/contact/law", "/cells/model"}, law,
                        "is for deformable cells alone. Set /cells/model to \"dcm\" for all "
                        "cells, or choose \"cohesive\"");
}

}  // namespace

void check_contact_law(const Scene& scene, Report& report) {
  if (scene.contact.law == dcm::ContactLaw::kCohesive) return;
  const std::string law = "\"" + name_of_choice(scene.contact.law) + "\"";
  check_alone(scene, law, report);
  if (scene.contact.quadrature != contact::Quadrature::kThreePoint)
    report.add_relation({"/contact/law", "/contact/quadrature"}, law,
                        "acts between triangles. Set /contact/quadrature to \"3-point\"");
  if (scene.contact.friction_form != dcm::FrictionForm::kSurface)
    report.add_relation({"/contact/law", "/friction/form"}, law,
                        "rubs where triangles press. Set /friction/form to \"surface\"");
  if (scene.life.sleep)
    report.add_relation({"/contact/law", "/life/sleep"}, law,
                        "never leaves cells in balance, its force jumps. Set /life/sleep to false");
  for (const auto& [name, type] : scene.cell_types)
    if (type.cycle.time > 0)
      report.add_relation({"/contact/law", "/cell_types/" + name + "/cycle/time"}, law,
                          fmt::format("is for cells that do not divide. Remove "
                                      "/cell_types/{}/cycle, or choose \"cohesive\"",
                                      name));
}

}  // namespace acinus::runs
