#pragma once
/// Requests and replies as the routes see them: no sockets.

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace acinus::runs {

struct HttpRequest {
  std::string method;                          ///< "GET"
  std::vector<std::string> path;               ///< "/runs/ID" as {"runs", "ID"}, as it was sent
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
  std::string fault;                                  ///< of its head; "" = none
  std::string header(const std::string& name) const;  ///< "" = none
  bool reads() const { return method == "GET" || method == "HEAD"; }
};

/// The next piece of a reply that goes on: "" where there is nothing new yet, nothing at its end.
using EventSource = std::function<std::optional<std::string>()>;

struct HttpReply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::string folder;  ///< of the file
  std::string file;    ///< inside the folder, sent instead of the body; "" = none
  EventSource events;  ///< sent instead of both; empty = none
  std::vector<std::pair<std::string, std::string>> headers;
};

/// Target of a request line to its parts; what stands behind ? is left out.
std::vector<std::string> split_target(std::string_view target);

HttpReply json_reply(int status, const nlohmann::ordered_json& value);
/// {"error": {"type": ..., "message": ...}}, the form of UM-Bridge.
HttpReply error_reply(int status, const std::string& type, const std::string& message);
HttpReply text_reply(const std::string& type, std::string_view text);

/// JSON on one line; bytes that are no UTF-8 become U+FFFD.
std::string json_line(const nlohmann::ordered_json& value);

/// A text from outside in quotes, for messages.
std::string quoted(const std::string& text);

/// One server-sent event. @pre no line break in `data`
std::string event_text(const std::string& data);

}  // namespace acinus::runs
