#include "runs/assemble/start_state.hpp"

#include <fmt/format.h>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "coupling/world/state_parts.hpp"
#include "io/checkpoint.hpp"
#include "runs/assemble/state_file.hpp"
#include "runs/scene/differences.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {

/// True if cells of the type of a key, "/cell_types/NAME/...", start at any age.
bool starts_at_any_age(const Scene& scene, const std::string& pointer) {
  const std::string name = pointer.substr(std::string("/cell_types/").size());
  const auto type = scene.cell_types.find(name.substr(0, name.find('/')));
  return type != scene.cell_types.end() && type->second.cycle.random_start;
}

}  // namespace

bool may_differ_at_start(const Scene& scene, const std::string& pointer) {
  const Entry* key = find_innermost_entry(pointer);
  if (key == nullptr) return false;
  if (key->affects == Affects::kAges) return !starts_at_any_age(scene, pointer);
  return key->affects >= Affects::kStep;
}

void save_start(const std::string& folder, const Scene& scene, const coupling::World& world) {
  io::CheckpointSource source;
  source.whole.put("scene", scene.resolved_json);
  source.whole.put("scene_hash", scene.hash);
  source.whole.put("version", ACINUS_VERSION);
  source.whole.put("state_hash",
                   fmt::format("{:016x}", coupling::hash_state(world.ranks, world.state)));
  put_state(world.ranks, world.state, source);
  if (world.ranks.is_root())
    io::save_state_file(folder + "/start.h5", source);
  else
    io::visit_parts(source);
}

std::string take_start(const Scene& scene, const StateTypes& types, coupling::State& state) {
  const io::CheckpointData data = io::load_state_file(scene.start_up.from + "/start.h5");
  std::string differences;
  for (const std::string& line :
       list_scene_differences(data.text("scene"), scene.resolved_json,
                              [&](const std::string& p) { return may_differ_at_start(scene, p); }))
    differences += "  " + line + "\n";
  check(differences.empty(),
        fmt::format("/start_up/from: {} started otherwise. Keys that differ (there -> here):\n{}"
                    "What shapes the start must be the same: let this scene make its own "
                    "start-up, or start from another run.",
                    data.source(), differences));
  get_state(data, types, state);
  return fmt::format("cells at t = 0 taken from {} (state {})", scene.start_up.from,
                     data.text("state_hash"));
}

}  // namespace acinus::runs
