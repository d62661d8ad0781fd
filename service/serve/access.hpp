#pragma once
/// Access to the service: by the token, and under the names by which it may be called. The names
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

/// The names under which a port of this machine is called.
std::vector<std::string> allowed_hosts(const std::string& address, int port,
                                       const std::vector<std::string>& names);

/// The reply that refuses a request: 403 for a foreign Host or Origin, 401 without the token, as
/// `Authorization: Bearer TOKEN`, the password of `Basic`, or the session of the login page.
/// Nothing if it may be answered.
std::optional<HttpReply> refuse(const ServiceAccess& access, const HttpRequest& request);

/// The reply to the login page's form, {"token": ...}.
HttpReply log_in(const ServiceAccess& access, const HttpRequest& request);

}  // namespace acinus::runs
