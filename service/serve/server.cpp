#include "service/serve/server.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/memory.hpp"
#include "runs/assemble/memory_need.hpp"
#include "service/serve/access.hpp"
#include "service/serve/connection.hpp"
#include "service/serve/connections.hpp"
#include "service/serve/dispatcher.hpp"
#include "service/serve/job_store.hpp"
#include "service/serve/routes.hpp"
#include "service/serve/token.hpp"

namespace acinus::service {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Configures the allocator to return freed memory to the system: requests are large and
/// short-lived, unlike the arrays of a simulation.
void return_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kLargeAllocation = 1 << 17;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLargeAllocation);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargeAllocation);
#endif
}

/// Raises the limit of open files: every event stream holds a socket.
void allow_many_files() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

void fill_in(ServeOptions& options) {
  if (options.jobs == 0)
    options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  constexpr double kMostMemoryShare = 0.9;  // the rest is for the system and this service
  if (options.max_memory == 0)
    options.max_memory = kMostMemoryShare * machine_memory() / options.jobs;
}

tcp::acceptor listen(asio::io_context& io, const ServeOptions& options) {
  boost::system::error_code failed;
  const asio::ip::address address = asio::ip::make_address(options.address, failed);
  check(!failed,
        fmt::format("--address {}: is no IP address, such as 127.0.0.1 or ::1", options.address));
  check(options.token || address.is_loopback(),
        fmt::format("--no-token: only for an address of this machine alone (127.0.0.1); at {} "
                    "anybody could submit runs",
                    options.address));
  try {
    return {io, {address, static_cast<std::uint16_t>(options.port)}};
  } catch (const boost::system::system_error& error) {
    throw Error(
        fmt::format("--address {} --port {}: cannot listen there: {}. Choose another "
                    "--port, or 0 for any that is free.",
                    options.address, options.port, error.code().message()));
  }
}

void warn_of_address(const ServeOptions& options, const tcp::acceptor& acceptor) {
  if (!acceptor.local_endpoint().address().is_loopback())
    fmt::print(stderr,
               "acinus: warning: --address {}: other machines can reach this service, and what "
               "they send, the token too, is not encrypted. Put a server with TLS before it.\n",
               options.address);
}

Task<void> accept(tcp::acceptor& acceptor, Routes& routes, const ServeOptions& options,
                  Connections& connections) {
  while (acceptor.is_open()) {
    boost::system::error_code failed;
    tcp::socket socket =
        co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, failed));
    if (!failed) {
      asio::co_spawn(acceptor.get_executor(),
                     serve_connection(std::move(socket), routes, options, connections),
                     [](const std::exception_ptr&) {});  // a broken connection
    } else if (acceptor.is_open()) {
      // Too many files, perhaps: some will be closed.
      asio::steady_timer timer(acceptor.get_executor(), std::chrono::milliseconds(100));
      co_await timer.async_wait(asio::use_awaitable);
    }
  }
}

void tell(const ServeOptions& options, const ServiceAccess& access, int port) {
  const bool six = options.address.find(':') != std::string::npos;
  const std::string host =
      fmt::format("{}:{}", six ? "[" + options.address + "]" : options.address, port);
  if (!access.token.empty()) {
    fmt::print("open http://{}/login#{}\nUM-Bridge clients: http://acinus:{}@{}\n", host,
               access.token, access.token, host);
  } else {
    fmt::print("open http://{}/\n", host);
  }
  fmt::print("{} runs at a time, kept in {}; Ctrl+C ends the service, runs with a checkpoint\n",
             options.jobs, options.data);
  std::fflush(stdout);
}

/// Runs the event loop until it is stopped. An exception in one handler does not end the others.
void run(asio::io_context& io) {
  for (;;) {
    try {
      io.run();
      return;
    } catch (const std::exception& error) {
      fmt::print(stderr, "acinus: warning: {}\n", error.what());
    }
  }
}

}  // namespace

void serve(ServeOptions options) {
  fill_in(options);
  allow_many_files();
  return_freed_memory();
  umask(077);               // files and locks of runs are for this account only
  Connections connections;  // before the loop, with which the last of them go
  asio::io_context io(1);
  tcp::acceptor acceptor = listen(io, options);
  const int port = acceptor.local_endpoint().port();
  JobStore store(options.data);
  // What runs calibrate counts with the rest.
  setenv("XDG_CACHE_HOME", store.cache_folder().c_str(), 1);
  Sessions sessions;
  const ServiceAccess access{options.token ? keep_token(store.folder() + "/token") : "",
                             allowed_hosts(options.address, port, options.names),
                             fmt::format("acinus_session_{}", port), sessions};
  Dispatcher dispatcher(io, options, store);
  for (const std::string& warning : dispatcher.warnings())
    fmt::print(stderr, "acinus: warning: {}\n", warning);
  Routes routes(io, options, access, store, dispatcher);
  asio::signal_set signals(io, SIGTERM, SIGINT);
  signals.async_wait([&](const boost::system::error_code&, int) {
    acceptor.close();
    if (!options.quiet) fmt::print("ending: runs write their checkpoints\n");
    std::fflush(stdout);
    dispatcher.end([&] { io.stop(); });
  });
  asio::co_spawn(io, accept(acceptor, routes, options, connections),
                 [](const std::exception_ptr&) {});
  warn_of_address(options, acceptor);
  dispatcher.begin();
  if (!options.quiet) tell(options, access, port);
  run(io);
}

}  // namespace acinus::service
