#include "runs/assemble/start_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "runs/assemble/state_file.hpp"
#include "runs/scene/differences.hpp"

namespace acinus::runs {
namespace {

/// Blocks and keys that may differ from the run that left the start: they act only after t = 0 or
/// only during start-up. "model" is merged into cells.model; of start_up only the keys that place
/// cells count. Contact with vessels shapes a start too, but both kinds may be compared from one
/// start.
constexpr std::array kFreeKeys{"/name",
                               "/description",
                               "/experiment",
                               "/model",
                               "/time",
                               "/solver",
                               "/output",
                               "/motility",
                               "/life",
                               "/friction",
                               "/start_up/growth_time",
                               "/start_up/adhesion_ramp",
                               "/start_up/max_duration",
                               "/start_up/speed_tolerance",
                               "/start_up/pressure_tolerance",
                               "/start_up/from",
                               "/vessels/contact"};

/// Keys of a cell type that may differ from the run that left the start.
constexpr std::array kFreeTypeKeys{"/cycle",
                                   "/inhibition",
                                   "/death",
                                   "/diffusion",
                                   "/dcm/nodal_friction",
                                   "/dcm/nodal_friction_across",
                                   "/dcm/ecm_friction",
                                   "/cbm/ecm_friction"};

bool is_or_is_below(const std::string& pointer, const std::string& block) {
  return pointer == block || pointer.starts_with(block + "/");
}

}  // namespace

bool may_differ_at_start(const Scene& scene, const std::string& pointer) {
  constexpr const char* kTypesPointer = "/cell_types/";
  if (!pointer.starts_with(kTypesPointer))
    return std::ranges::any_of(kFreeKeys,
                               [&](const char* key) { return is_or_is_below(pointer, key); });
  const std::size_t end = pointer.find('/', std::string(kTypesPointer).size());
  if (end == std::string::npos) return false;
  const std::string rest = pointer.substr(end), first = std::string(kTypesPointer);
  const auto type = scene.cell_types.find(pointer.substr(first.size(), end - first.size()));
  const bool any_age = type != scene.cell_types.end() && type->second.cycle.random_start;
  if (rest == "/cycle/start" || (any_age && is_or_is_below(rest, "/cycle"))) return false;
  return std::ranges::any_of(kFreeTypeKeys,
                             [&](const char* key) { return is_or_is_below(rest, key); });
}

void save_start(const std::string& folder, const Scene& scene, const coupling::State& state) {
  io::CheckpointData data;
  data.put("scene", scene.resolved_json);
  data.put("scene_hash", scene.hash);
  data.put("version", ACINUS_VERSION);
  data.put("state_hash", fmt::format("{:016x}", coupling::hash_state(state)));
  put_state(state, data);
  io::save_state_file(folder + "/start.h5", data);
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
