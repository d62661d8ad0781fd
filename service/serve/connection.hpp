#pragma once
/// One HTTP/1.1 connection on a socket.

#include <boost/asio/ip/tcp.hpp>

#include "service/serve/async.hpp"
#include "service/serve/connections.hpp"
#include "service/serve/routes.hpp"

namespace acinus::service {

/// Serves requests until the client goes, is too slow or sends invalid HTTP.
Task<void> serve_connection(boost::asio::ip::tcp::socket socket, Routes& routes,
                            const ServeOptions& options, Connections& connections);

}  // namespace acinus::service
