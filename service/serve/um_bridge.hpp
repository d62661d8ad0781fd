#pragma once
/// The protocol UM-Bridge 1.0: models evaluated over HTTP by clients in many languages.
/// [Seelinger2023]

#include <boost/asio/io_context.hpp>
#include <map>
#include <string>

#include "service/serve/async.hpp"
#include "service/serve/dispatcher.hpp"
#include "service/serve/http_message.hpp"
#include "service/serve/models.hpp"
#include "service/serve/preparation.hpp"

namespace acinus::runs {

class UmBridge {
 public:
  UmBridge(boost::asio::io_context& io, const ServeOptions& options, JobStore& store,
           Dispatcher& dispatcher, Preparation& preparation);

  /// Whether a request is one of the protocol's.
  static bool is_asked(const HttpRequest& request);
  /// Waits for the run where one is needed.
  Task<HttpReply> answer(const HttpRequest& request);

 private:
  const Models& models();
  Task<HttpReply> evaluate(const StudyModel& model, const ModelConfig& config,
                           const std::vector<double>& values);
  std::string result_file(const std::string& key) const;
  /// The job that evaluates a key; nothing when there is none.
  RunJob* find_job(const std::string& key);
  /// Prepares an evaluation and submits it, unless its key is being evaluated or its result known.
  /// @param text  as evaluation_text() makes it
  /// @return its key
  Task<std::string> submit(const std::string& text);

  boost::asio::io_context& io_;
  const ServeOptions& options_;
  JobStore& store_;
  Dispatcher& dispatcher_;
  Preparation& preparation_;
  std::optional<Models> models_;
  std::map<std::string, std::string> job_by_key_;  ///< evaluations that are not yet done
  /// Keys of evaluations by text: one that is asked for again needs no preparation.
  std::map<std::string, std::string> key_by_text_;
};

}  // namespace acinus::runs
