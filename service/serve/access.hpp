#pragma once
/// Access control of the service by token and host name. Checking the host name keeps foreign web
/// pages from a service on the reader's own machine.

#include <optional>
#include <string>
#include <vector>

#include "service/serve/http_message.hpp"
#include "service/serve/sessions.hpp"

namespace acinus::service {

/// Credentials and names under which the service may be used.
struct ServiceAccess {
  std::string token;               ///< "" = no authentication
  std::vector<std::string> hosts;  ///< allowed values of the header Host: "127.0.0.1:8642"
  /// Cookie name; contains the port, since services of one machine share cookies.
  std::string cookie;
  Sessions& sessions;
};

/// Allowed host names of a port of this machine.
std::vector<std::string> allowed_hosts(const std::string& address, int port,
                                       const std::vector<std::string>& names);

/// Reply that refuses a request: 403 for a foreign Host or Origin, 401 without authentication by
/// `Authorization: Bearer TOKEN`, the password of `Basic`, or the session of the login page. Empty
/// if access is granted.
std::optional<HttpReply> refuse(const ServiceAccess& access, const HttpRequest& request);

/// Reply to the form of the login page, {"token": ...}.
HttpReply log_in(const ServiceAccess& access, const HttpRequest& request);

}  // namespace acinus::service
