#include "service/serve/job_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ranges>

#include "acinus_version.hpp"
#include "service/serve/results.hpp"

namespace acinus::service {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kMostListed = 200;
constexpr int kQuietPolls = 30;  ///< polls without news before a keep-alive comment
/// Limits of a run's entry in a list; GET /runs/ID returns it in full.
constexpr std::size_t kMostListedSet = 8, kMostListedText = 200;
constexpr const char* kKeepAliveComment = ": still here\n\n";

std::string shortened(const std::string& text) {
  return text.size() <= kMostListedText ? text : text.substr(0, kMostListedText) + "...";
}

OrderedJson view_shortly(const RunJob& job) {
  OrderedJson j = view_job(job);
  OrderedJson set = OrderedJson::array();
  for (std::size_t k = 0; k < std::min(job.set.size(), kMostListedSet); ++k)
    set.push_back(shortened(job.set[k]));
  if (job.set.size() > kMostListedSet)
    set.push_back(fmt::format("... and {} more", job.set.size() - kMostListedSet));
  j["set"] = set;
  j["cause"] = shortened(job.cause);
  return j;
}

}  // namespace

OrderedJson view_job(const RunJob& job) {
  OrderedJson j = {{"id", job.id},
                   {"name", job.name},
                   {"scene", job.scene},
                   {"set", job.set},
                   {"created", job.created},
                   {"state", name_of(job.state)},
                   {"phase", job.phase},
                   {"time_s", job.time_s},
                   {"end_s", job.end_s},
                   {"left_s", nullptr},
                   {"cells", {{"dcm", job.dcm}, {"cbm", job.cbm}}},
                   {"bytes", job.bytes},
                   {"wall_s", job.used_s},
                   {"evaluation", job.evaluation},
                   {"cause", job.cause}};
  if (job.left_s >= 0) j["left_s"] = job.left_s;
  return j;
}

const std::string& JobList::text() {
  if (!text_.empty() && revision_ == dispatcher_.revision()) return text_;
  revision_ = dispatcher_.revision();
  std::map<std::string, int> count;
  for (const auto& [id, job] : dispatcher_.jobs()) ++count[name_of(job->state)];
  OrderedJson runs = OrderedJson::array();
  for (const auto& [id, job] : std::views::reverse(dispatcher_.jobs())) {
    if (job->evaluation && job->state != JobState::kFailed) continue;
    if (runs.size() == kMostListed) break;
    runs.push_back(view_shortly(*job));
  }
  text_ = json_line({{"version", ACINUS_VERSION},
                     {"count", count},
                     {"disk_bytes", dispatcher_.disk_bytes()},
                     {"runs", runs}});
  return text_;
}

EventSource watch_job(Dispatcher& dispatcher, const std::string& id) {
  return [&dispatcher, id, reported = std::optional<std::uint64_t>(),
          quiet = 0]() mutable -> std::optional<std::string> {
    const RunJob* job = dispatcher.find(id);
    if (job == nullptr) return std::nullopt;
    if (reported != job->revision) {
      reported = job->revision;
      quiet = 0;
      return event_text(json_line(view_job(*job)));
    }
    return ++quiet % kQuietPolls == 0 ? kKeepAliveComment : "";
  };
}

EventSource watch_list(const Dispatcher& dispatcher, JobList& list) {
  return [&dispatcher, &list, reported = std::optional<std::uint64_t>(),
          quiet = 0]() mutable -> std::optional<std::string> {
    if (reported != dispatcher.revision()) {
      reported = dispatcher.revision();
      quiet = 0;
      return event_text(list.text());
    }
    return ++quiet % kQuietPolls == 0 ? kKeepAliveComment : "";
  };
}

std::string view_series(const std::string& run_folder) {
  std::error_code code;
  if (!std::filesystem::exists(run_folder + "/run.vtkhdf", code)) return "{}";
  return result_text(read_run_result(run_folder));
}

}  // namespace acinus::service
