#pragma once
/// One connection: HTTP/1.1 to and from the socket.

#include <boost/asio/ip/tcp.hpp>

#include "service/serve/async.hpp"
#include "service/serve/connections.hpp"
#include "service/serve/routes.hpp"

namespace acinus::runs {

/// Answers requests until the client goes, is too slow or sends what is no HTTP.
Task<void> serve_connection(boost::asio::ip::tcp::socket socket, Routes& routes,
                            const ServeOptions& options, Connections& connections);

}  // namespace acinus::runs
