#include "service/serve/job.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::service {
namespace {

std::string record_file(const std::string& folder) { return folder + "/job.json"; }

constexpr std::string_view kForm = "dddddddd-dddddd-dddddd";

}  // namespace

const char* name_of(JobState state) {
  switch (state) {
    case JobState::kWaiting:
      return "waiting";
    case JobState::kRunning:
      return "running";
    case JobState::kStopped:
      return "stopped";
    case JobState::kCompleted:
      return "completed";
    case JobState::kFailed:
      return "failed";
  }
  return "";
}

bool is_job_id(const std::string& text) {
  return std::ranges::equal(text, kForm, [](char c, char form) {
    return form == 'd' ? '0' <= c && c <= '9' : c == form;
  });
}

std::string make_job_id() {
  const auto now =
      std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now());
  const auto second = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{:%Y%m%d-%H%M%S}-{:06d}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(second)),
                     (now - second).count());
}

void write_job(const std::string& folder, const RunJob& job) {
  const nlohmann::ordered_json j = {
      {"id", job.id},           {"name", job.name},     {"scene", job.scene},
      {"set", job.set},         {"key", job.key},       {"evaluation", job.evaluation},
      {"created", job.created}, {"kills", job.kills},   {"checkpoint_s", job.checkpoint_s},
      {"used_s", job.used_s},   {"failed", job.failed}, {"cause", job.cause}};
  io::write_text_file(
      record_file(folder),
      j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

/// Smallest simulated time of a record: times of the start-up phase are negative.
constexpr double kEarliest = -std::numeric_limits<double>::max();

RunJob read_job(const std::string& folder) {
  RunJob job;
  try {
    const auto j = runs::parse_or_discard<nlohmann::json>(io::read_text_file(record_file(folder)));
    job.id = j.at("id");
    job.name = j.at("name");
    job.scene = j.at("scene");
    job.set = j.at("set").get<std::vector<std::string>>();
    job.key = j.at("key");
    job.evaluation = j.at("evaluation");
    job.created = j.at("created");
    job.kills = runs::count_at(j, "kills", record_file(folder));
    job.checkpoint_s = runs::seconds_at(j, "checkpoint_s", record_file(folder), kEarliest);
    job.used_s = runs::seconds_at(j, "used_s", record_file(folder));
    job.failed = j.at("failed");
    job.cause = j.at("cause");
  } catch (const nlohmann::json::exception& e) {
    throw Error(fmt::format("{}: not the record of a run of this service ({})", record_file(folder),
                            e.what()));
  }
  return job;
}

}  // namespace acinus::service
