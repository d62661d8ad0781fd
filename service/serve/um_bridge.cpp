#include "service/serve/um_bridge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "runs/scene/bounded_json.hpp"
#include "service/serve/submission.hpp"

namespace acinus::service {
namespace {

namespace asio = boost::asio;
using Json = nlohmann::json;

constexpr std::array kPosts{"ModelInfo",     "InputSizes",   "OutputSizes", "Evaluate",
                            "ApplyJacobian", "ApplyHessian", "Gradient"};
constexpr auto kResultPoll = std::chrono::milliseconds(20);
constexpr std::size_t kMostRememberedKeys = 1000;  ///< remembered evaluation keys
constexpr std::size_t kMostBodyBytes = 256'000;  ///< bytes; parsed on the thread of the event loop

HttpReply invalid_input(const std::string& message) {
  return error_reply(400, "InvalidInput", message);
}

/// Input vector of an evaluation.
/// @param n  number of parameters
/// @throws Error for another form
std::vector<double> read_input(const Json& body, std::size_t n) {
  check(body.contains("input") && body["input"].is_array() && body["input"].size() == 1 &&
            body["input"][0].is_array(),
        "\"input\" is a list of one list of numbers");
  const Json& values = body["input"][0];
  check(
      values.size() == n,
      fmt::format("{} numbers in \"input\", where the model has {} parameters", values.size(), n));
  check(std::ranges::all_of(values, [](const Json& v) { return v.is_number(); }),
        "\"input\" holds something that is no number");
  return values.get<std::vector<double>>();
}

}  // namespace

UmBridge::UmBridge(asio::io_context& io, const ServeOptions& options, JobStore& store,
                   Dispatcher& dispatcher, Preparation& preparation)
    : io_(io),
      options_(options),
      store_(store),
      dispatcher_(dispatcher),
      preparation_(preparation) {
  for (const auto& [id, job] : dispatcher_.jobs())
    if (job->evaluation) job_by_key_[job->key] = id;
  dispatcher_.on_evaluated = [this](const RunJob& job, const std::string& folder) {
    const std::string file = result_file(job.key);
    keep_result(file, read_run_result(folder));
    std::error_code gone;
    const auto bytes = std::filesystem::file_size(file, gone);
    if (!gone) dispatcher_.add_disk(static_cast<double>(bytes));
    // Later: the dispatcher is still busy with it.
    asio::post(io_, [this, id = job.id] {
      if (RunJob* done = dispatcher_.find(id)) {
        job_by_key_.erase(done->key);
        dispatcher_.remove(*done);
      }
    });
  };
}

bool UmBridge::is_asked(const HttpRequest& request) {
  if (request.path.size() != 1) return false;
  return request.path[0] == "Info" || std::ranges::count(kPosts, request.path[0]) > 0;
}

const Models& UmBridge::models() {
  if (!models_) models_.emplace();  // takes a moment: not before it is asked for
  return *models_;
}

std::string UmBridge::result_file(const std::string& key) const {
  return store_.results_folder() + "/" + key + ".json";
}

Task<HttpReply> UmBridge::answer(const HttpRequest& request) {
  const std::string& what = request.path[0];
  if (what == "Info") {
    std::vector<std::string> names;
    for (const auto& [name, model] : models().all()) names.push_back(name);
    co_return json_reply(200, {{"protocolVersion", 1.0}, {"models", names}});
  }
  if (request.body.size() > kMostBodyBytes)
    co_return invalid_input(fmt::format("the request has more than {} bytes", kMostBodyBytes));
  const Json body = runs::parse_or_discard<Json>(request.body);
  if (!body.is_object())
    co_return invalid_input("the request must be a JSON object of at most 100 levels");
  const std::string name = runs::text_at(body, "name");
  const auto found = models().all().find(name);
  if (found == models().all().end())
    co_return error_reply(400, "ModelNotFound",
                          fmt::format("no model {}; GET /Info lists them", quoted(name)));
  const StudyModel& model = found->second;
  if (what == "ModelInfo")
    co_return json_reply(200, {{"support",
                                {{"Evaluate", true},
                                 {"Gradient", false},
                                 {"ApplyJacobian", false},
                                 {"ApplyHessian", false}}}});
  if (what == "Gradient" || what.starts_with("Apply"))
    co_return error_reply(400, "UnsupportedFeature",
                          "models here have no derivatives: cells divide at whole steps");
  std::string fault;
  try {
    const ModelConfig config = read_config(model, body.value("config", Json()));
    for (const std::string& assignment : config.set) check_names_no_file(assignment);
    if (what == "InputSizes")
      co_return json_reply(200, {{"inputSizes", {config.parameters.size()}}});
    if (what == "OutputSizes") co_return json_reply(200, {{"outputSizes", {config.n_output()}}});
    const std::vector<double> values = read_input(body, config.parameters.size());
    co_return co_await evaluate(model, config, values);
  } catch (const Error& error) {
    fault = error.what();
  }
  co_return invalid_input(fault);
}

RunJob* UmBridge::find_job(const std::string& key) {
  const auto known = job_by_key_.find(key);
  return known == job_by_key_.end() ? nullptr : dispatcher_.find(known->second);
}

Task<std::string> UmBridge::submit(const std::string& text) {
  dispatcher_.check_room();
  RunJob job = co_await preparation_.prepare_evaluation(text);
  const std::string key = job.key;
  if (key_by_text_.size() >= kMostRememberedKeys) key_by_text_.clear();
  key_by_text_[text] = key;
  // Another text may have the same key.
  if (find_job(key) == nullptr && !find_result(result_file(key)))
    job_by_key_[key] = dispatcher_.submit(std::move(job)).id;
  else
    store_.remove(job);
  co_return key;
}

Task<HttpReply> UmBridge::evaluate(const StudyModel& model, const ModelConfig& config,
                                   const std::vector<double>& values) {
  const runs::Scene& scene = model_scene(model, config);
  const std::string text =
      evaluation_text(scene.name, scene.resolved_json, model_changes(config, values));
  asio::steady_timer timer(co_await asio::this_coro::executor);
  const auto known = key_by_text_.find(text);
  std::string key = known == key_by_text_.end() ? "" : known->second;
  for (bool first = true;; first = false) {
    if (const std::optional<RunResult> result = find_result(result_file(key)))
      co_return json_reply(200, {{"output", {model_output(model, config, *result)}}});
    RunJob* job = find_job(key);
    if (first && job == nullptr) {
      key = co_await submit(text);
      continue;
    }
    if (job == nullptr || job->state == JobState::kCompleted)
      co_return error_reply(500, "ModelFailed", "the run left no result");
    if (first && job->state == JobState::kStopped) dispatcher_.resume(*job);
    if (job->state == JobState::kFailed || job->state == JobState::kStopped)
      co_return error_reply(500, "ModelFailed",
                            fmt::format("run {} {}: {}", job->id, name_of(job->state), job->cause));
    timer.expires_after(kResultPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
}

}  // namespace acinus::service
