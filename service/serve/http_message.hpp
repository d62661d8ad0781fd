#pragma once
/// HTTP requests and replies, independent of sockets.

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace acinus::service {

/// Parsed HTTP request.
struct HttpRequest {
  std::string method;                          ///< "GET"
  std::vector<std::string> path;               ///< "/runs/ID" as {"runs", "ID"}, not decoded
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
  std::string fault;                                  ///< of the head; "" = none
  std::string header(const std::string& name) const;  ///< "" = none
  bool reads() const { return method == "GET" || method == "HEAD"; }
};

/// Source of the pieces of a streamed reply: "" if there is nothing new, empty at its end.
using EventSource = std::function<std::optional<std::string>()>;

/// HTTP reply: a body, a file, or a stream of events.
struct HttpReply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::string folder;  ///< of the file
  std::string file;    ///< relative to `folder`, sent as the body; "" = none
  EventSource events;  ///< streamed as the body; empty = none
  std::vector<std::pair<std::string, std::string>> headers;
};

/// Path segments of a request target, without the query.
std::vector<std::string> split_target(std::string_view target);

/// Reply with a JSON body.
HttpReply json_reply(int status, const nlohmann::ordered_json& value);
/// Error reply in the form of UM-Bridge: {"error": {"type": ..., "message": ...}}.
HttpReply error_reply(int status, const std::string& type, const std::string& message);
HttpReply text_reply(const std::string& type, std::string_view text);

/// JSON text on one line; bytes that are not UTF-8 become U+FFFD.
std::string json_line(const nlohmann::ordered_json& value);

/// Quotes an external text for messages.
std::string quoted(const std::string& text);

/// Text of one server-sent event.
/// @pre no line break in `data`
std::string event_text(const std::string& data);

}  // namespace acinus::service
