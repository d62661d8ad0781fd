#include "runs/study/run_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "io/disk.hpp"
#include "io/file_lock.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/scene/differences.hpp"
#include "runs/scene/entries.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/run_folder.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

std::string folder_of(const std::string& root, const StudyRun& run) {
  return root + "/" + run.folder;
}
std::string record_file(const std::string& root, const StudyRun& run) {
  return folder_of(root, run) + "/study_run.json";
}

std::optional<OrderedJson> read_record(const std::string& root, const StudyRun& run) {
  const std::string file = record_file(root, run);
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return std::nullopt;
  OrderedJson j = parse_or_discard<OrderedJson>(io::read_text_file(file));
  if (!j.is_object()) return std::nullopt;
  return j;
}

/// True for keys without effect on results. The start is compared by the scenes it came from.
bool is_without_effect(const std::string& pointer) {
  const Entry* key = find_innermost_entry(pointer);
  return key != nullptr && key->affects == Affects::kNothing;
}

/// True if the folders of a run and of those it starts from hold these very scenes. Hashes alone
/// would also differ by descriptions and by keys newer than a run.
bool has_same_scenes(const std::string& root, const StudyRun& run) {
  const auto holds = [&](const std::string& folder, const std::string& scene) {
    const std::string file = root + "/" + folder + "/scene.json";
    std::error_code code;
    if (!fs::is_regular_file(file, code)) return false;
    try {
      return list_scene_differences(io::read_text_file(file), scene, is_without_effect).empty();
    } catch (const std::exception&) {
      return false;  // damaged, so not known to be this scene
    }
  };
  return holds(run.folder, run.scene.resolved_json) &&
         std::ranges::all_of(
             run.sources, [&](const auto& source) { return holds(source.first, source.second); });
}

bool belongs(const std::string& root, const OrderedJson& record, const StudyRun& run) {
  if (text_at(record, "version") != ACINUS_VERSION) return false;
  return text_at(record, "identity") == run.identity || has_same_scenes(root, run);
}

void take_summary(const std::string& folder, RunStatus& status) {
  std::error_code code;
  if (!fs::is_regular_file(folder + "/summary.json", code)) return;
  try {
    const RunSummary s = read_summary(folder);
    status.cpu_s = s.cpu_s;
    status.wall_s = s.wall_s;
    status.simulated_s = s.simulated_s;
    status.state_hash = s.state_hash;
    status.start_hash = s.start_hash;
    status.version = s.version;
    status.git = s.git;
    if (s.status == RunOutcome::kCompleted) status.state = RunState::kDone;
    if (s.status == RunOutcome::kFailed) status.state = RunState::kFailed;
    if (!s.cause.empty()) status.cause = s.cause;
  } catch (const Error& error) {
    status.cause = error.what();
  }
}

}  // namespace

const char* name_of(RunState state) {
  switch (state) {
    case RunState::kToDo:
      return "to do";
    case RunState::kToResume:
      return "to resume";
    case RunState::kRunning:
      return "running";
    case RunState::kDone:
      return "done";
    case RunState::kFailed:
      return "failed";
    case RunState::kRefused:
      return "refused";
    case RunState::kKilled:
      return "killed";
    case RunState::kStale:
      return "of another scene or version";
  }
  return "";
}

bool has_failed(RunState state) {
  return state == RunState::kFailed || state == RunState::kRefused || state == RunState::kKilled;
}

bool is_left(RunState state) {
  return state == RunState::kToDo || state == RunState::kToResume || state == RunState::kRefused ||
         state == RunState::kKilled;
}

RunStatus inspect_run(const std::string& root, const StudyRun& run, bool held) {
  RunStatus status;
  const std::string folder = folder_of(root, run);
  std::error_code code;
  if (!fs::is_directory(folder, code)) return status;
  const std::optional<OrderedJson> record = read_record(root, run);
  if (!record) {
    if (fs::exists(folder + "/run.vtkhdf", code)) status.state = RunState::kStale;
    return status;
  }
  if (!belongs(root, *record, run)) {
    status.state = RunState::kStale;
    return status;
  }
  status.cause = text_at(*record, "cause");
  if (!status.cause.empty())
    status.state =
        record->value("killed", OrderedJson()) == true ? RunState::kKilled : RunState::kRefused;
  if (io::has_checkpoint(folder)) status.state = RunState::kToResume;
  take_summary(folder, status);
  if (status.state == RunState::kDone || status.state == RunState::kFailed) return status;
  if (!held && (io::is_locked(claim_file(root, run)) || is_being_written(folder)))
    status.state = RunState::kRunning;
  return status;
}

void write_record(const std::string& root, const StudyPlan& plan, const StudyRun& run,
                  const AttemptEnd& end) {
  OrderedJson j;
  j["study"] = plan.study.name;
  j["variant"] = plan.variant_of(run).name;
  j["seed"] = run.seed;
  j["identity"] = run.identity;
  j["version"] = ACINUS_VERSION;
  if (run.source >= 0) j["start"] = plan.runs[run.source].name;
  if (!end.cause.empty()) j["cause"] = end.cause;
  if (end.killed) j["killed"] = true;
  io::write_text_file(record_file(root, run),
                      j.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n");
}

std::string claim_file(const std::string& root, const StudyRun& run) {
  return folder_of(root, run) + "/claim.lock";
}

std::string describe_missing_start(const StudyRun& source, const RunStatus& status) {
  return fmt::format("{}, from whose start it goes on, left none{}{}", source.name,
                     status.cause.empty() ? "" : ": ", status.cause);
}

bool has_start(const std::string& root, const StudyRun& run) {
  const std::optional<OrderedJson> record = read_record(root, run);
  std::error_code code;
  return record && belongs(root, *record, run) &&
         fs::is_regular_file(folder_of(root, run) + "/start.h5", code);
}

}  // namespace acinus::runs
