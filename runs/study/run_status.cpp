#include "runs/study/run_status.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/disk.hpp"
#include "core/io/file_lock.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/run_folder.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string folder_of(const std::string& root, const StudyRun& run) {
  return root + "/" + run.folder;
}
std::string record_file(const std::string& root, const StudyRun& run) {
  return folder_of(root, run) + "/study_run.json";
}

std::optional<Json> read_record(const std::string& root, const StudyRun& run) {
  const std::string file = record_file(root, run);
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return std::nullopt;
  Json j = parse_or_discard<Json>(io::read_text_file(file));
  if (!j.is_object()) return std::nullopt;
  return j;
}

bool belongs(const Json& record, const StudyRun& run) {
  return text_at(record, "identity") == run.identity &&
         text_at(record, "version") == ACINUS_VERSION;
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
    if (s.status == "completed") status.state = RunState::kDone;
    if (s.status == "failed") status.state = RunState::kFailed;
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
    case RunState::kStale:
      return "of another scene or version";
  }
  return "";
}

RunStatus inspect_run(const std::string& root, const StudyRun& run, bool held) {
  RunStatus status;
  const std::string folder = folder_of(root, run);
  std::error_code code;
  if (!fs::is_directory(folder, code)) return status;
  const std::optional<Json> record = read_record(root, run);
  if (!record) {
    if (fs::exists(folder + "/run.vtkhdf", code)) status.state = RunState::kStale;
    return status;
  }
  if (!belongs(*record, run)) {
    status.state = RunState::kStale;
    return status;
  }
  status.cause = text_at(*record, "cause");
  if (io::has_checkpoint(folder)) status.state = RunState::kToResume;
  take_summary(folder, status);
  if (status.state == RunState::kDone || status.state == RunState::kFailed) return status;
  if (!held && (io::is_locked(claim_file(root, run)) || is_being_written(folder)))
    status.state = RunState::kRunning;
  return status;
}

void write_record(const std::string& root, const StudyPlan& plan, const StudyRun& run,
                  const std::string& cause) {
  Json j;
  j["study"] = plan.study.name;
  j["variant"] = plan.variant_of(run).name;
  j["seed"] = run.seed;
  j["identity"] = run.identity;
  j["version"] = ACINUS_VERSION;
  if (run.source >= 0) j["start"] = plan.runs[run.source].name;
  if (!cause.empty()) j["cause"] = cause;
  io::write_text_file(record_file(root, run), j.dump(2) + "\n");
}

std::string claim_file(const std::string& root, const StudyRun& run) {
  return folder_of(root, run) + "/claim.lock";
}

bool has_start(const std::string& root, const StudyRun& run) {
  const std::optional<Json> record = read_record(root, run);
  std::error_code code;
  return record && belongs(*record, run) &&
         fs::is_regular_file(folder_of(root, run) + "/start.h5", code);
}

}  // namespace acinus::runs
