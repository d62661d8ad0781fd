#pragma once
/// Scene of a run as JSON for the report page.

#include <nlohmann/json_fwd.hpp>

namespace acinus::service {

/// Values of a scene that differ from their defaults: key, value, default (null: none), meaning.
/// Blocks and lists of blocks are searched value by value; name and description are left out.
/// @param scene  resolved, as recorded in a run file
nlohmann::ordered_json list_changed_values(const nlohmann::ordered_json& scene);

/// Walls given by a formula: planes, those of the lobule included, and the capsule. Each has kind,
/// name, position, speed, travel, opens (null: never) and, for planes, mirror; um and s.
/// @param scene  resolved, as recorded in a run file
/// @throws Error or nlohmann::json::exception for blocks that no program wrote
nlohmann::ordered_json list_walls(const nlohmann::ordered_json& scene);

}  // namespace acinus::service
