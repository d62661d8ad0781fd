#include <fmt/format.h>

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

}  // namespace

std::vector<Drag> drag_of(const std::string& resolved_scene, bool has_dcm, bool has_cbm) try {
  std::vector<Drag> out;
  const Json j = parse_bounded<Json>(resolved_scene, "the scene of a run");
  const Json& type = j.at("cell_types").begin().value();
  const double radius = quantity(type.at("radius"), kLength), surface = 4 * kPi * radius * radius;
  for (const CellModel model : {CellModel::kDcm, CellModel::kCbm}) {
    if (!(model == CellModel::kDcm ? has_dcm : has_cbm)) continue;
    const std::string name = name_of_choice(model), pair = fmt::format("{0}_{0}", name);
    out.push_back({model, surface * quantity(type.at(name).at("ecm_friction"), kFrictionPerArea),
                   quantity(j.at("friction").at(pair), kFrictionPerArea)});
  }
  return out;
} catch (const Json::exception&) {
  throw Error("the scene that a run keeps is damaged: it lacks what every scene has.",
              Exit::kFileError);
}

}  // namespace acinus::runs
