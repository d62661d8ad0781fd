#include "service/serve/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/beast/core/detail/base64.hpp>
#include <nlohmann/json.hpp>

#include "runs/scene/bounded_json.hpp"
#include "service/serve/token.hpp"

namespace acinus::service {
namespace {

std::string decode_base64(const std::string& text) {
  namespace base64 = boost::beast::detail::base64;
  std::string out(base64::decoded_size(text.size()) + 3, '\0');
  out.resize(base64::decode(out.data(), text.data(), text.size()).first);
  return out;
}

std::string session_of(const ServiceAccess& access, const HttpRequest& request) {
  const std::string cookies = request.header("cookie"), name = access.cookie + "=";
  for (std::size_t at = 0; at < cookies.size();) {
    const std::size_t end = std::min(cookies.find(';', at), cookies.size());
    std::string one = cookies.substr(at, end - at);
    one.erase(0, one.find_first_not_of(' '));
    if (one.starts_with(name)) return one.substr(name.size());
    at = end + 1;
  }
  return "";
}

/// Token of the Authorization header; "" = none.
std::string header_token(const HttpRequest& request) {
  const std::string value = request.header("authorization");
  if (value.starts_with("Bearer ")) return value.substr(7);
  if (!value.starts_with("Basic ")) return "";
  const std::string pair = decode_base64(value.substr(6));
  const std::size_t colon = pair.find(':');
  return colon == std::string::npos ? "" : pair.substr(colon + 1);
}

bool is_own_origin(const ServiceAccess& access, const std::string& origin) {
  return std::ranges::any_of(access.hosts, [&](const std::string& host) {
    return origin == "http://" + host || origin == "https://" + host;
  });
}

HttpReply refused(const std::string& message) {
  HttpReply reply = error_reply(401, "Unauthorized", message);
  reply.headers.emplace_back("WWW-Authenticate", "Bearer");
  return reply;
}

}  // namespace

std::vector<std::string> allowed_hosts(const std::string& address, int port,
                                       const std::vector<std::string>& names) {
  std::vector<std::string> hosts;
  std::vector<std::string> all{
      "127.0.0.1", "localhost", "[::1]",
      address.find(':') == std::string::npos ? address : "[" + address + "]"};
  all.insert(all.end(), names.begin(), names.end());
  for (const std::string& name : all) {
    hosts.push_back(fmt::format("{}:{}", name, port));
    // Behind another server, which has the usual port.
    if (port == 80 || std::ranges::count(names, name) > 0) hosts.push_back(name);
  }
  return hosts;
}

std::optional<HttpReply> refuse(const ServiceAccess& access, const HttpRequest& request) {
  if (std::ranges::count(access.hosts, request.header("host")) == 0)
    return error_reply(403, "Forbidden",
                       "this service is not called by that name; --name allows it");
  const std::string origin = request.header("origin");
  if (!origin.empty() && !is_own_origin(access, origin))
    return error_reply(403, "Forbidden", "asked by the page of another origin");
  if (request.path == std::vector<std::string>{"login"} || access.token.empty())
    return std::nullopt;
  if (const std::string token = header_token(request); !token.empty())
    return same_secret(token, access.token)
               ? std::nullopt
               : std::optional(refused("the token is not that of this service"));
  if (!access.sessions.knows(session_of(access, request)))
    return refused("a token is needed: the line that `acinus serve` prints has it");
  // A browser sends cookies with requests of any page: a request for a change must name its origin.
  if (!request.reads() && origin.empty() && request.header("sec-fetch-site") != "same-origin")
    return error_reply(403, "Forbidden", "a cookie alone changes nothing: no Origin was sent");
  return std::nullopt;
}

HttpReply log_in(const ServiceAccess& access, const HttpRequest& request) {
  if (access.token.empty()) return error_reply(404, "NotFound", "this service asks for no token");
  const auto form = runs::parse_or_discard<nlohmann::json>(request.body);
  if (!same_secret(runs::text_at(form, "token"), access.token))
    return refused("the token is not that of this service");
  HttpReply reply;
  reply.status = 204;
  reply.headers.emplace_back("Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                                       access.cookie, access.sessions.open()));
  return reply;
}

}  // namespace acinus::service
