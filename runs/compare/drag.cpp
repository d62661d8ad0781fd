#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "core/vec.hpp"
#include "runs/compare/compare.hpp"
#include "runs/compare/scene_differences.hpp"

namespace acinus::runs {
namespace {

using Json = nlohmann::json;

double quantity(const Json& j, Dimension dimension) {
  return parse_quantity(j.get<std::string>(), dimension);
}

/// What may differ between runs of the same scene: which cells are which model, the constants of
/// spheres, and how the run was made.
bool may_differ(const std::string& path) {
  for (const char* start : {"/name", "/description", "/model", "/cells/model", "/zoom", "/time",
                            "/solver", "/output", "/friction/cbm", "/friction/dcm_cbm", "/contact"})
    if (path.starts_with(start)) return true;
  return path.starts_with("/cell_types/") && path.find("/cbm/") != std::string::npos;
}

}  // namespace

std::vector<Drag> drag_of(const std::string& resolved_scene, bool has_dcm, bool has_cbm) {
  std::vector<Drag> out;
  const Json j = Json::parse(resolved_scene);
  const Json& type = j.at("cell_types").begin().value();
  const double radius = quantity(type.at("radius"), kLength), surface = 4 * kPi * radius * radius;
  for (const char* model : {"dcm", "cbm"}) {
    if (!(model == std::string("dcm") ? has_dcm : has_cbm)) continue;
    const std::string pair = fmt::format("{0}_{0}", model);
    out.push_back({model, surface * quantity(type.at(model).at("ecm_friction"), kFrictionPerArea),
                   quantity(j.at("friction").at(pair), kFrictionPerArea)});
  }
  return out;
}

std::vector<std::string> scene_differences(const std::string& a, const std::string& b) {
  const Json from = Json::parse(a), to = Json::parse(b);
  std::vector<std::string> out;
  for (const Json& change : Json::diff(from, to))
    if (const std::string path = change.at("path"); !may_differ(path)) out.push_back(path);
  return out;
}

}  // namespace acinus::runs
