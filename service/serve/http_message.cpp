#include "service/serve/http_message.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace acinus::service {

std::string json_line(const nlohmann::ordered_json& value) {
  return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string quoted(const std::string& text) { return json_line(text); }

std::string HttpRequest::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

std::vector<std::string> split_target(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  std::vector<std::string> parts;
  while (!target.empty()) {
    const std::size_t slash = target.find('/');
    if (slash != 0) parts.emplace_back(target.substr(0, slash));
    target = slash == std::string_view::npos ? "" : target.substr(slash + 1);
  }
  return parts;
}

HttpReply json_reply(int status, const nlohmann::ordered_json& value) {
  HttpReply reply;
  reply.status = status;
  reply.body = json_line(value) + "\n";
  return reply;
}

HttpReply error_reply(int status, const std::string& type, const std::string& message) {
  return json_reply(status, {{"error", {{"type", type}, {"message", message}}}});
}

HttpReply text_reply(const std::string& type, std::string_view text) {
  HttpReply reply;
  reply.type = type;
  reply.body = text;
  return reply;
}

std::string event_text(const std::string& data) { return fmt::format("data: {}\n\n", data); }

}  // namespace acinus::service
