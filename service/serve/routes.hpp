#pragma once
/// Dispatch of HTTP requests to their handlers (docs/howto/service.md).

#include <boost/asio/io_context.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "service/serve/access.hpp"
#include "service/serve/async.hpp"
#include "service/serve/dispatcher.hpp"
#include "service/serve/http_message.hpp"
#include "service/serve/job_view.hpp"
#include "service/serve/preparation.hpp"
#include "service/serve/um_bridge.hpp"

namespace acinus::service {

/// Handlers of all requests of the service.
class Routes {
 public:
  Routes(boost::asio::io_context& io, const ServeOptions& options, const ServiceAccess& access,
         JobStore& store, Dispatcher& dispatcher);

  /// True if the head of a request grants access; bodies of other requests are not read.
  bool is_allowed(const HttpRequest& head) const {
    return !refuse(access_, head) && head.path != std::vector<std::string>{"login"};
  }
  /// Handles a request. Faults of the request become error replies, not exceptions.
  Task<HttpReply> answer(const HttpRequest& request);

 private:
  /// True for the id of a run; only what has the form of one is ever looked for.
  bool is_known(const std::string& id) { return is_job_id(id) && dispatcher_.find(id) != nullptr; }
  HttpReply answer_page(const HttpRequest& request);
  Task<HttpReply> submit(const HttpRequest& request);
  Task<HttpReply> answer_run(const HttpRequest& request, const std::string& id,
                             const std::string& what);
  Task<HttpReply> report(std::string id);
  Task<HttpReply> compare(std::string a, std::string b);
  Task<std::string> make_report(std::string key, std::vector<std::string> folders,
                                std::vector<std::string> titles, std::string fresh);
  std::string title_of(const std::string& id);
  HttpReply series(const RunJob& job);
  HttpReply list_files(const std::string& id);
  HttpReply send_file(const std::string& id, const std::string& name);

  boost::asio::io_context& io_;
  const ServeOptions& options_;
  const ServiceAccess& access_;
  JobStore& store_;
  Dispatcher& dispatcher_;
  JobList list_;
  Preparation preparation_;
  UmBridge um_bridge_;
  /// Runs and pairs of runs whose report is being made. Shared with the coroutines, which outlive
  /// this object: they are destroyed with the event loop.
  std::shared_ptr<std::set<std::string>> making_ = std::make_shared<std::set<std::string>>();
};

}  // namespace acinus::service
