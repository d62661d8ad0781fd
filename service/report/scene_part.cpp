#include "service/report/scene_part.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/units/units.hpp"
#include "core/vec.hpp"
#include "coupling/generate/domain.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::service {
namespace {

using OrderedJson = nlohmann::ordered_json;

bool is_list_of_blocks(const OrderedJson& value) {
  return value.is_array() && !value.empty() &&
         std::ranges::all_of(value, [](const OrderedJson& item) { return item.is_object(); });
}

void add_changed(const std::string& key, const OrderedJson& value, OrderedJson& list) {
  if (is_list_of_blocks(value)) {
    for (std::size_t k = 0; k < value.size(); ++k)
      add_changed(key + "." + std::to_string(k), value[k], list);
    return;
  }
  if (value.is_object() && !value.empty()) {
    for (const auto& [name, inner] : value.items())
      add_changed(key.empty() ? name : key + "." + name, inner, list);
    return;
  }
  if (key == "name" || key == "description") return;
  const runs::Entry* entry = runs::find_entry(key);
  OrderedJson initial = nullptr;
  if (entry != nullptr && !entry->initial.empty()) {
    initial = OrderedJson::parse(entry->initial, nullptr, false);
    if (initial == value) return;
  }
  list.push_back({{"key", key},
                  {"value", value},
                  {"default", initial.is_discarded() ? OrderedJson(nullptr) : initial},
                  {"meaning", entry == nullptr ? "" : entry->meaning}});
}

double quantity(const OrderedJson& block, const char* name, Dimension dimension) {
  return parse_quantity(block.at(name).get<std::string>(), dimension);
}

OrderedJson opening_time(const OrderedJson& block) {
  if (block.at("opens") == "auto") return nullptr;
  return quantity(block, "opens", kTime);
}

OrderedJson position(const OrderedJson& block, const char* name) {
  OrderedJson x = OrderedJson::array();
  for (const OrderedJson& part : block.at(name))
    x.push_back(parse_quantity(part.get<std::string>(), kLength));
  return x;
}

OrderedJson numbers_of(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

void add_lobule_planes(const OrderedJson& block, OrderedJson& list) {
  coupling::LobuleParameters p;
  p.shape = block.at("shape") == "hexagon" ? coupling::LobuleShape::kHexagon
                                           : coupling::LobuleShape::kPie;
  p.radius = quantity(block, "radius", kLength);
  p.height = quantity(block, "height", kLength);
  p.central_vein_radius = quantity(block, "central_vein_radius", kLength);
  p.portal_vein_radius = quantity(block, "portal_vein_radius", kLength);
  for (const coupling::MirrorPlane& plane : coupling::make_domain(p).plane)
    list.push_back({{"kind", "plane"},
                    {"name", plane.name},
                    {"point", numbers_of(plane.point)},
                    {"normal", numbers_of(plane.normal)},
                    {"speed", 0},
                    {"travel", 0},
                    {"opens", nullptr},
                    {"mirror", true}});
}

OrderedJson describe_plane(const OrderedJson& wall) {
  return {{"kind", "plane"},
          {"name", wall.at("name")},
          {"point", position(wall, "point")},
          {"normal", wall.at("normal").get<std::vector<double>>()},
          {"speed", quantity(wall, "speed", kSpeed)},
          {"travel", quantity(wall, "travel", kLength)},
          {"opens", opening_time(wall)},
          {"mirror", wall.at("mirror").get<bool>()}};
}

OrderedJson describe_capsule(const OrderedJson& capsule) {
  return {{"kind", "capsule"},
          {"name", "capsule"},
          {"point", position(capsule, "center")},
          {"radius", quantity(capsule, "radius", kLength)},
          {"speed", quantity(capsule, "speed", kSpeed)},
          {"min_radius", quantity(capsule, "min_radius", kLength)},
          {"opens", opening_time(capsule)}};
}

/// True if a scene has a block or a list of this name that is not empty.
bool has(const OrderedJson& scene, const char* name) {
  return scene.contains(name) && !scene.at(name).empty();
}

}  // namespace

OrderedJson list_changed_values(const OrderedJson& scene) {
  OrderedJson list = OrderedJson::array();
  add_changed("", scene, list);
  return list;
}

OrderedJson list_walls(const OrderedJson& scene) {
  OrderedJson list = OrderedJson::array();
  if (has(scene, "lobule")) add_lobule_planes(scene.at("lobule"), list);
  if (has(scene, "walls"))
    for (const OrderedJson& wall : scene.at("walls")) list.push_back(describe_plane(wall));
  if (has(scene, "capsule")) list.push_back(describe_capsule(scene.at("capsule")));
  return list;
}

}  // namespace acinus::service
