#include "service/serve/routes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/inside.hpp"
#include "runs/scene/schema.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/child.hpp"
#include "runs/study/active_run.hpp"
#include "service/page/page_assets.hpp"

namespace acinus::service {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;
using Path = std::vector<std::string>;

/// Downloadable files of a run folder.
constexpr std::array kFiles{"scene.json", "summary.json", "run.vtkhdf", "run.vtkhdf.sums",
                            "run.xmf",    "run.log",      "output.txt", "checkpoint.h5",
                            "start.h5",   "report.html"};
constexpr double kReportLimit = 120;   ///< wall time, s
constexpr double kReportMemory = 8e9;  ///< address space, bytes
constexpr int kMostReports = 2;        ///< concurrent
constexpr std::size_t kMostReportBytes = 64'000'000;
/// Licence notice before the bundled script, which contains third-party code.
constexpr const char* kServiceNotice = "/*! Licences: /page/licences.txt */\n";
constexpr auto kReportPoll = std::chrono::milliseconds(50);

HttpReply not_found(const std::string& message) { return error_reply(404, "NotFound", message); }
HttpReply no_run(const std::string& id) {
  return not_found(fmt::format("no run {}; GET /runs lists them", quoted(id)));
}
HttpReply wrong_method(const char* allowed) {
  HttpReply reply = error_reply(405, "MethodNotAllowed", fmt::format("allowed: {}", allowed));
  reply.headers.emplace_back("Allow", allowed);
  return reply;
}
HttpReply from_error(const Error& error) {
  const bool clients = error.code() == Exit::kBadInput;
  return error_reply(clients ? 400 : 503, clients ? "InvalidInput" : "FileError", error.what());
}

/// Content security policy of the service's page: only resources of the service; frames are its own
/// reports.
constexpr const char* kPagePolicy =
    "default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; frame-ancestors "
    "'self'; "
    "base-uri 'none'; form-action 'self'";
/// Policy of the login page, which has an inline script, since unauthenticated clients may fetch
/// nothing.
constexpr const char* kLoginPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src "
    "'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";
/// Policy of reports: isolated from the service, without cookies and requests.
constexpr const char* kReportPolicy = "sandbox allow-scripts allow-downloads";

HttpReply page(std::string_view text, const char* policy, int status = 200) {
  HttpReply reply = text_reply("text/html; charset=utf-8", text);
  reply.status = status;
  reply.headers.emplace_back("Content-Security-Policy", policy);
  return reply;
}

OrderedJson library_of(const std::vector<runs::ShippedScene>& documents) {
  OrderedJson all = OrderedJson::array();
  for (const runs::ShippedScene& d : documents)
    all.push_back({{"name", d.name}, {"description", d.description}});
  return all;
}

fs::file_time_type time_of(const std::string& file) {
  std::error_code code;
  const fs::file_time_type time = fs::last_write_time(file, code);
  return code ? fs::file_time_type::min() : time;
}

}  // namespace

Routes::Routes(asio::io_context& io, const ServeOptions& options, const ServiceAccess& access,
               JobStore& store, Dispatcher& dispatcher)
    : io_(io),
      options_(options),
      access_(access),
      store_(store),
      dispatcher_(dispatcher),
      list_(dispatcher),
      preparation_(options, store),
      um_bridge_(io, options, store, dispatcher, preparation_) {}

Task<HttpReply> Routes::answer(const HttpRequest& request) {
  if (std::optional<HttpReply> refusal = refuse(access_, request)) {
    const bool browser = request.reads() && request.path.empty() && refusal->status == 401;
    co_return browser ? page(kLoginPage, kLoginPolicy, 401) : std::move(*refusal);
  }
  std::optional<HttpReply> fault;
  try {
    const Path& path = request.path;
    if (UmBridge::is_asked(request)) co_return co_await um_bridge_.answer(request);
    if (path.empty() || path[0] == "page" || path[0] == "login") co_return answer_page(request);
    if (path == Path{"scenes"})
      co_return request.reads() ? json_reply(200, library_of(runs::shipped_scenes()))
                                : wrong_method("GET");
    if (path == Path{"schema"})
      co_return request.reads() ? text_reply("application/json", runs::scene_schema())
                                : wrong_method("GET");
    if (path == Path{"check"} || path == Path{"preview"}) {
      if (request.method != "POST") co_return wrong_method("POST");
      std::string text;  // not a conditional expression: gcc 12 destroys its operands too early
      if (path[0] == "check")
        text = co_await preparation_.check_submission(request.body);
      else
        text = co_await preparation_.preview(request.body);
      co_return text_reply("application/json", text);
    }
    if (path[0] == "compare" && path.size() == 3) {
      for (const std::string& id : {path[1], path[2]})
        if (!is_known(id)) co_return no_run(id);
      if (!request.reads()) co_return wrong_method("GET");
      co_return co_await compare(path[1], path[2]);
    }
    if (path == Path{"events"}) {
      if (!request.reads()) co_return wrong_method("GET");
      HttpReply reply;
      reply.events = watch_list(dispatcher_, list_);
      co_return reply;
    }
    if (path[0] == "runs" && path.size() == 1) {
      if (request.method == "POST") co_return co_await submit(request);
      if (!request.reads()) co_return wrong_method("GET, POST");
      co_return text_reply("application/json", list_.text() + "\n");
    }
    if (path[0] == "runs" && path.size() <= 4) {
      if (!is_known(path[1])) co_return no_run(path[1]);
      const std::string id = path[1], what = path.size() > 2 ? path[2] : std::string();
      if (path.size() == 4 && what == "files" && request.reads()) co_return send_file(id, path[3]);
      if (path.size() == 4) co_return not_found("a run has no such part");
      co_return co_await answer_run(request, id, what);
    }
  } catch (const Error& error) {
    fault = from_error(error);
  }
  co_return fault ? *fault : not_found("no such place; docs/howto/service.md lists what there is");
}

HttpReply Routes::answer_page(const HttpRequest& request) {
  const Path& path = request.path;
  if (path == Path{"login"} && request.method == "POST") return log_in(access_, request);
  if (!request.reads()) return wrong_method("GET");
  if (path.empty()) return page(kServicePage, kPagePolicy);
  if (path == Path{"login"}) return page(kLoginPage, kLoginPolicy);
  if (path == Path{"page", "service.js"})
    return text_reply("text/javascript", std::string(kServiceNotice) + std::string(kServiceScript));
  if (path == Path{"page", "preview.js"})
    return text_reply("text/javascript", std::string(kServiceNotice) + std::string(kPreviewScript));
  if (path == Path{"page", "licences.txt"})
    return text_reply("text/plain; charset=utf-8", kPageLicences);
  if (path == Path{"page", "service.css"}) return text_reply("text/css", kServiceStyle);
  return not_found("the page has no such part");
}

Task<HttpReply> Routes::submit(const HttpRequest& request) {
  dispatcher_.check_room();
  const RunJob& job = dispatcher_.submit(co_await preparation_.prepare(request.body));
  HttpReply reply = json_reply(201, view_job(job));
  reply.headers.emplace_back("Location", "/runs/" + job.id);
  co_return reply;
}

Task<HttpReply> Routes::answer_run(const HttpRequest& request, const std::string& id,
                                   const std::string& what) {
  RunJob& job = *dispatcher_.find(id);
  if (what == "stop" || what == "resume") {
    if (request.method != "POST") co_return wrong_method("POST");
    what == "stop" ? dispatcher_.stop(job) : dispatcher_.resume(job);
    co_return json_reply(202, view_job(job));
  }
  if (what.empty() && request.method == "DELETE") {
    dispatcher_.remove(job);
    HttpReply reply;
    reply.status = 204;
    co_return reply;
  }
  if (!request.reads()) co_return wrong_method(what.empty() ? "GET, DELETE" : "GET");
  if (what.empty()) co_return json_reply(200, view_job(job));
  if (what == "events") {
    HttpReply reply;
    reply.events = watch_job(dispatcher_, id);
    co_return reply;
  }
  if (what == "files") co_return list_files(id);
  if (what == "series") co_return series(job);
  if (what == "report") co_return co_await report(id);
  co_return not_found("a run has no such part");
}

HttpReply Routes::series(const RunJob& job) {
  try {
    return text_reply("application/json", view_series(store_.run_folder(job.id)) + "\n");
  } catch (const Error&) {
    // The file may be just in the making.
    if (job.state != JobState::kRunning) throw;
    return text_reply("application/json", "{}\n");
  }
}

HttpReply Routes::list_files(const std::string& id) {
  OrderedJson all = OrderedJson::array();
  for (const char* name : kFiles) {
    if (const auto size = io::size_inside(store_.run_folder(id), name))
      all.push_back({{"name", name}, {"bytes", *size}});
  }
  return json_reply(200, all);
}

HttpReply Routes::send_file(const std::string& id, const std::string& name) {
  const auto known = std::ranges::find(kFiles, name);
  if (known == kFiles.end() || !io::is_file_inside(store_.run_folder(id), *known))
    return not_found(fmt::format("run {} has no such file; GET /runs/{}/files lists them", id, id));
  HttpReply reply;
  reply.folder = store_.run_folder(id);
  reply.file = *known;
  reply.type = name.ends_with(".json") ? "application/json" : "application/octet-stream";
  reply.headers.emplace_back("Content-Disposition",
                             fmt::format("attachment; filename=\"{}-{}\"", id, name));
  return reply;
}

std::string Routes::title_of(const std::string& id) {
  const RunJob* job = dispatcher_.find(id);
  return job != nullptr ? job->name : id;
}

/// Makes a report in a child process, since that takes time and may crash.
/// @param key    of this report among those that are being made
/// @param fresh  the new page
/// @return cause of a failure; empty if the page was made
Task<std::string> Routes::make_report(std::string key, std::vector<std::string> folders,
                                      std::vector<std::string> titles, std::string fresh) {
  asio::steady_timer timer(co_await asio::this_coro::executor);
  making_->insert(key);
  const struct Done {
    std::shared_ptr<std::set<std::string>> making;
    std::string key;
    ~Done() { making->erase(key); }
  } done{making_, key};
  const std::string words = fresh + ".txt";
  std::error_code ignored;
  fs::remove(words, ignored);
  std::vector<std::string> call{"report"};
  call.insert(call.end(), folders.begin(), folders.end());
  call.insert(call.end(), {"--out", fresh});
  for (const std::string& title : titles) call.push_back("--title=" + title);
  runs::Child child(call, {.output = words,
                           .limit_s = kReportLimit,
                           .follows_parent = true,
                           .most_memory = kReportMemory});
  // Not the descriptor: the coroutine may go before the child does.
  while (!runs::wait_for_any({&child}, 0)) {
    timer.expires_after(kReportPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
  const runs::ChildEnd end = child.collect();
  std::string cause;
  if (end.code != 0) cause = "no report could be made: " + runs::printed_cause(words);
  fs::remove(words, ignored);
  co_return cause;
}

Task<HttpReply> Routes::report(std::string id) {
  const std::string folder = store_.run_folder(id), file = folder + "/report.html";
  asio::steady_timer timer(co_await asio::this_coro::executor);
  while (making_->contains(id) || static_cast<int>(making_->size()) >= kMostReports) {
    timer.expires_after(kReportPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
  if (time_of(file) < time_of(folder + "/run.vtkhdf") || time_of(file) == time_of("")) {
    const std::string fresh = folder + "/report.new.html";
    const std::vector<std::string> folders{folder}, titles{title_of(id)};
    const std::string cause = co_await make_report(id, folders, titles, fresh);
    if (!cause.empty()) co_return error_reply(503, "FileError", cause);
    std::error_code ignored;
    fs::rename(fresh, file, ignored);
    dispatcher_.measure(id);
  }
  HttpReply reply;
  reply.folder = folder;
  reply.file = "report.html";
  reply.type = "text/html; charset=utf-8";
  reply.headers.emplace_back("Content-Security-Policy", kReportPolicy);
  co_return reply;
}

/// Report of two runs with their comparison. It is not kept: pairs of runs are many.
Task<HttpReply> Routes::compare(std::string a, std::string b) {
  if (a == b) co_return error_reply(400, "InvalidInput", "two different runs are compared");
  for (const std::string& id : {a, b}) {
    const JobState state = dispatcher_.find(id)->state;
    if (state == JobState::kWaiting || state == JobState::kRunning)
      co_return error_reply(400, "InvalidInput",
                            fmt::format("run {} has not ended; it is compared when it has", id));
  }
  const std::string key = a + "+" + b;
  asio::steady_timer timer(co_await asio::this_coro::executor);
  while (making_->contains(key) || static_cast<int>(making_->size()) >= kMostReports) {
    timer.expires_after(kReportPoll);
    co_await timer.async_wait(asio::use_awaitable);
  }
  const std::string folder = store_.run_folder(a), name = "comparison-" + b + ".html";
  const std::string fresh = folder + "/" + name;
  const std::vector<std::string> folders{store_.run_folder(a), store_.run_folder(b)};
  const std::vector<std::string> titles{title_of(a), title_of(b)};
  const std::string cause = co_await make_report(key, folders, titles, fresh);
  if (!cause.empty()) co_return error_reply(503, "FileError", cause);
  HttpReply reply =
      text_reply("text/html; charset=utf-8", io::read_text_inside(folder, name, kMostReportBytes));
  reply.headers.emplace_back("Content-Security-Policy", kReportPolicy);
  std::error_code ignored;
  fs::remove(fresh, ignored);
  co_return reply;
}

}  // namespace acinus::service
