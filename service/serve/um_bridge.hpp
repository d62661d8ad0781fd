#pragma once
/// UM-Bridge protocol 1.0: evaluation of models over HTTP [Seelinger2023].

#include <boost/asio/io_context.hpp>
#include <map>
#include <string>

#include "service/serve/async.hpp"
#include "service/serve/dispatcher.hpp"
#include "service/serve/http_message.hpp"
#include "service/serve/models.hpp"
#include "service/serve/preparation.hpp"

namespace acinus::service {

/// Handler of UM-Bridge requests.
class UmBridge {
 public:
  UmBridge(boost::asio::io_context& io, const ServeOptions& options, JobStore& store,
           Dispatcher& dispatcher, Preparation& preparation);

  /// True for a request of the protocol.
  static bool is_asked(const HttpRequest& request);
  /// Handles a request; waits for a run if one is needed.
  Task<HttpReply> answer(const HttpRequest& request);

 private:
  const Models& models();
  Task<HttpReply> evaluate(const StudyModel& model, const ModelConfig& config,
                           const std::vector<double>& values);
  std::string result_file(const std::string& key) const;
  /// Job that evaluates a key; null if there is none.
  RunJob* find_job(const std::string& key);
  /// Prepares an evaluation and submits it, unless its key is being evaluated or its result is
  /// cached.
  /// @param text  as made by evaluation_text()
  /// @return its key
  Task<std::string> submit(const std::string& text);

  boost::asio::io_context& io_;
  const ServeOptions& options_;
  JobStore& store_;
  Dispatcher& dispatcher_;
  Preparation& preparation_;
  std::optional<Models> models_;
  std::map<std::string, std::string> job_by_key_;  ///< evaluations in progress
  /// Keys of evaluations by text, which save the preparation of repeated ones.
  std::map<std::string, std::string> key_by_text_;
};

}  // namespace acinus::service
