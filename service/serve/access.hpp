#pragma once
/// Who may ask for what: the token, and the names by which the service may be called. The names
/// keep web pages of others from reaching a service on the reader's own machine.

#include <optional>
#include <string>
#include <vector>

#include "service/serve/http_message.hpp"
#include "service/serve/sessions.hpp"

namespace acinus::runs {

struct ServiceAccess {
  std::string token;               ///< "" = none is asked for
  std::vector<std::string> hosts;  ///< allowed values of Host: "127.0.0.1:8642"
  std::string cookie;              ///< name, with the port: services of one machine share cookies
  Sessions& sessions;
};

/// 32 hexadecimal digits from the system's generator.   @throws Error(kFileError)
std::string make_token();

/// The token that stands in a file; a new one, readable by its owner only, where there is none.
/// @throws Error(kBadInput) for a file that others made, or could have written; kFileError
std::string keep_token(const std::string& file);

/// The names under which a port of this machine is called.
std::vector<std::string> allowed_hosts(const std::string& address, int port,
                                       const std::vector<std::string>& names);

/// Whether two texts are the same, in a time that does not tell where they differ.
bool same_secret(const std::string& a, const std::string& b);

/// The reply that refuses a request: 403 for a foreign Host or Origin, 401 without the token, as
/// `Authorization: Bearer TOKEN`, the password of `Basic`, or the session of the login page.
/// Nothing if it may be answered.
std::optional<HttpReply> refuse(const ServiceAccess& access, const HttpRequest& request);

/// The reply to the login page's form, {"token": ...}.
HttpReply log_in(const ServiceAccess& access, const HttpRequest& request);

}  // namespace acinus::runs
