#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units/units.hpp"
#include "core/vec.hpp"
#include "runs/compare/compare.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::runs {
namespace {

using Json = nlohmann::json;

double quantity(const Json& j, Dimension dimension) {
  return parse_quantity(j.get<std::string>(), dimension);
}

/// Friction between cells of one model, nN s/um^3; NaN where the law of the spheres sets it.
double cell_friction(const Json& scene, const Json& type, CellModel model) {
  const std::string name = name_of_choice(model);
  const Json& pair = scene.at("friction").at(fmt::format("{0}_{0}", name));
  if (pair != "auto") return quantity(pair, kFrictionPerArea);
  const bool has_law = type.at("cbm").at("stiffness_correction") != "none";
  return has_law ? std::numeric_limits<double>::quiet_NaN() : cbm::Params{}.cell_friction;
}

}  // namespace

std::vector<Drag> drag_of(const std::string& resolved_scene, bool has_dcm, bool has_cbm) try {
  std::vector<Drag> out;
  const Json j = parse_bounded<Json>(resolved_scene, "the scene of a run");
  const Json& type = j.at("cell_types").begin().value();
  const double radius = quantity(type.at("radius"), kLength), surface = 4 * kPi * radius * radius;
  for (const CellModel model : {CellModel::kDcm, CellModel::kCbm}) {
    if (!(model == CellModel::kDcm ? has_dcm : has_cbm)) continue;
    const Json& medium = type.at(name_of_choice(model)).at("ecm_friction");
    out.push_back(
        {model, surface * quantity(medium, kFrictionPerArea), cell_friction(j, type, model)});
  }
  return out;
} catch (const Json::exception&) {
  throw Error("the scene that a run keeps is damaged: it lacks what every scene has.",
              Exit::kFileError);
}

}  // namespace acinus::runs
