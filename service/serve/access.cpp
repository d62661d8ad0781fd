#include "service/serve/access.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/beast/core/detail/base64.hpp>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/inside.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::runs {
namespace {

constexpr std::size_t kMostToken = 4096;  ///< bytes

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

/// The token of the Authorization header; "" = none.
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

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  check(getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
        "no random numbers from the system", Exit::kFileError);
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::string keep_token(const std::string& file) {
  struct stat status {};
  if (lstat(file.c_str(), &status) == 0) {
    check(S_ISREG(status.st_mode) && status.st_uid == geteuid() && (status.st_mode & 077) == 0,
          fmt::format("{}: others made it or can read or write it, so it may be no secret. Remove "
                      "it, and a new one is made.",
                      file));
    std::string token = io::read_text_beside(file, kMostToken);
    while (!token.empty() && token.back() == '\n') token.pop_back();
    check(token.size() >= 16,
          fmt::format("{}: holds no token of 16 characters or more. Remove it, and a new one is "
                      "made.",
                      file));
    return token;
  }
  const std::string token = make_token(), line = token + "\n";
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) io::fail_on_disk(file, "be made", errno);
  const bool written =
      io::write_all(descriptor, reinterpret_cast<const std::byte*>(line.data()), line.size(), 0);
  const int error = errno;
  close(descriptor);
  if (!written) io::fail_on_disk(file, "be written", error);
  return token;
}

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

bool same_secret(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < a.size() && !b.empty(); ++k)
    difference |= static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k % b.size()]);
  return difference == 0;
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
  // A browser sends cookies along whoever made it ask; what changes something must say who did.
  if (!request.reads() && origin.empty() && request.header("sec-fetch-site") != "same-origin")
    return error_reply(403, "Forbidden", "a cookie alone changes nothing: no Origin was sent");
  return std::nullopt;
}

HttpReply log_in(const ServiceAccess& access, const HttpRequest& request) {
  if (access.token.empty()) return error_reply(404, "NotFound", "this service asks for no token");
  const auto form = parse_or_discard<nlohmann::json>(request.body);
  if (!same_secret(text_at(form, "token"), access.token))
    return refused("the token is not that of this service");
  HttpReply reply;
  reply.status = 204;
  reply.headers.emplace_back("Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                                       access.cookie, access.sessions.open()));
  return reply;
}

}  // namespace acinus::runs
