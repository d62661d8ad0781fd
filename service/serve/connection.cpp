#include "service/serve/connection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/file_posix.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/file_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <utility>

#include "io/inside.hpp"

namespace acinus::service {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

constexpr auto kClientTimeout = std::chrono::seconds(30);    ///< timeout of a slow client
constexpr auto kStrangerTimeout = std::chrono::seconds(10);  ///< timeout before authentication
constexpr auto kRoomPoll = std::chrono::milliseconds(20);
constexpr auto kDrainTime =
    std::chrono::seconds(2);  ///< time to discard input after the last reply
constexpr auto kEventPoll = std::chrono::milliseconds(500);
constexpr std::uint32_t kMostHeaderBytes = 16384;  ///< bytes
constexpr std::uint64_t kMostStrangerBody = 4096;  ///< before authentication, bytes

constexpr std::array kSingleHeaders{"host",           "origin",        "authorization",
                                    "content-length", "content-type",  "transfer-encoding",
                                    "expect",         "sec-fetch-site"};

HttpRequest take_head(const http::request_header<>& head) {
  HttpRequest request;
  request.method = std::string(head.method_string());
  request.path = split_target({head.target().data(), head.target().size()});
  for (const auto& field : head) {
    std::string name(field.name_string());
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto [known, fresh] = request.headers.emplace(name, field.value());
    // Servers that read the other one would see another request.
    if (!fresh && std::ranges::count(kSingleHeaders, name) > 0)
      request.fault = fmt::format("the head has {} twice", name);
  }
  const std::string coding = request.header("transfer-encoding");
  if (!coding.empty() && (coding != "chunked" || request.headers.contains("content-length")))
    request.fault = "the only Transfer-Encoding is chunked, and then without Content-Length";
  return request;
}

HttpReply too_large() {
  return error_reply(413, "TooLarge",
                     "the request is larger than this service allows (--max-body)");
}

template <class Body>
http::response<Body> make_head(const HttpReply& reply, bool keep_alive) {
  http::response<Body> head{static_cast<http::status>(reply.status), 11};
  head.set(http::field::content_type, reply.type);
  head.set(http::field::cache_control, "no-store");
  head.set("X-Content-Type-Options", "nosniff");
  head.set("Referrer-Policy", "no-referrer");
  head.set("Cross-Origin-Resource-Policy", "same-origin");
  for (const auto& [name, value] : reply.headers) head.insert(name, value);
  head.keep_alive(keep_alive);
  return head;
}

class Connection {
 public:
  Connection(asio::ip::tcp::socket socket, Routes& routes, const ServeOptions& options,
             Connections& connections)
      : stream_(std::move(socket)),
        routes_(routes),
        options_(options),
        connections_(connections),
        stranger_(connections.add_stranger([this] { stream_.close(); })) {}
  ~Connection() {
    become_known();
    give_room();
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Task<void> serve() {
    while (co_await serve_one()) {
    }
    beast::error_code ignored;
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    co_await drain();
  }

 private:
  auto token() { return asio::redirect_error(asio::use_awaitable, failed_); }

  /// Discards remaining input before the socket is closed; a reset would otherwise lose the reply.
  Task<void> drain() {
    std::array<char, 65536> bytes;
    stream_.expires_after(kDrainTime);
    failed_ = {};
    while (!failed_) co_await stream_.async_read_some(asio::buffer(bytes), token());
  }

  void become_known() {
    if (stranger_) connections_.forget_stranger(*std::exchange(stranger_, std::nullopt));
  }

  void give_room() { connections_.give_room(std::exchange(room_, 0)); }

  /// Waits until the receive budget admits the body.
  /// @return false on timeout
  Task<bool> take_room(double bytes) {
    asio::steady_timer timer(stream_.get_executor());
    const auto end = std::chrono::steady_clock::now() + kClientTimeout;
    while (!connections_.take_room(bytes)) {
      if (std::chrono::steady_clock::now() > end) co_return false;
      timer.expires_after(kRoomPoll);
      co_await timer.async_wait(token());
    }
    room_ = bytes;
    co_return true;
  }

  /// Reads the body, of an unauthenticated client only a few bytes.
  /// @return false if a refusal was sent or the client has gone
  Task<bool> take_body(http::request_parser<http::string_body>& parser, bool allowed) {
    if (!allowed) {
      parser.body_limit(
          kMostStrangerBody);  // of chunks; the length was compared with the other one
      if (parser.content_length().value_or(0) > kMostStrangerBody) {
        const HttpReply reply = too_large();
        co_await send(reply, false);
        co_return false;
      }
    }
    if (allowed && !parser.is_done()) {
      const double length = static_cast<double>(
          parser.content_length().value_or(static_cast<std::uint64_t>(options_.max_body)));
      stream_.expires_never();
      bool room = true;
      if (length <= options_.max_body) room = co_await take_room(length);
      if (!room) {
        const HttpReply busy = error_reply(503, "Busy", "too much is being received; try again");
        co_await send(busy, false);
        co_return false;
      }
      stream_.expires_after(kClientTimeout);
    }
    if (parser.get()[http::field::expect] == "100-continue") {
      http::response<http::empty_body> go_on{http::status::continue_, 11};
      co_await http::async_write(stream_, go_on, token());
    }
    co_await http::async_read(stream_, buffer_, parser, token());
    if (!failed_) co_return true;
    co_await refuse_what_is_no_request();
    co_return false;
  }

  /// Serves one request.
  /// @return true if the connection may carry another
  Task<bool> serve_one() {
    http::request_parser<http::string_body> parser;
    parser.header_limit(kMostHeaderBytes);
    parser.body_limit(static_cast<std::uint64_t>(options_.max_body));
    stream_.expires_after(stranger_ ? kStrangerTimeout : kClientTimeout);
    co_await http::async_read_header(stream_, buffer_, parser, token());
    if (failed_) co_return co_await refuse_what_is_no_request();
    HttpRequest request = take_head(parser.get());
    head_only_ = request.method == "HEAD";
    if (!request.fault.empty()) {
      const HttpReply reply = error_reply(400, "BadRequest", request.fault);
      co_return co_await send(reply, false);
    }
    const bool allowed = routes_.is_allowed(request);
    if (allowed) become_known();
    const bool received = co_await take_body(parser, allowed);
    if (!received) co_return false;
    request.body = std::move(parser.get().body());
    const bool keep_alive = parser.get().keep_alive();
    stream_.expires_never();  // an evaluation may take hours
    const HttpReply reply = co_await answer(std::move(request));
    give_room();
    co_return co_await send(reply, keep_alive);
  }

  Task<bool> refuse_what_is_no_request() {
    const bool is_http =
        failed_.category() == http::make_error_code(http::error::bad_method).category();
    if (!is_http || failed_ == http::error::end_of_stream ||
        failed_ == http::error::partial_message)
      co_return false;  // gone, or too slow
    const bool too_long = failed_ == http::error::body_limit;
    const HttpReply reply =
        too_long ? too_large() : error_reply(400, "BadRequest", failed_.message());
    stream_.expires_after(kClientTimeout);
    co_return co_await send(reply, false);
  }

  /// Computes the reply. An internal error becomes status 500 and does not end the service.
  Task<HttpReply> answer(HttpRequest request) {
    std::string fault;
    try {
      co_return co_await routes_.answer(request);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    fmt::print(stderr, "acinus: internal error while answering {}: {}\n", request.method, fault);
    co_return error_reply(500, "InternalError", fault);
  }

  Task<bool> send(const HttpReply& reply, bool keep_alive) {
    if (reply.events) co_return co_await send_events(reply);
    if (!reply.file.empty()) co_return co_await send_file(reply, keep_alive);
    auto response = make_head<http::string_body>(reply, keep_alive);
    response.body() = reply.body;
    response.prepare_payload();
    const bool written = co_await write(response);
    co_return written&& keep_alive;
  }

  Task<bool> send_file(const HttpReply& reply, bool keep_alive) {
    auto response = make_head<http::file_body>(reply, keep_alive);
    io::Descriptor found = io::open_inside(reply.folder, reply.file);
    if (found.valid()) {
      beast::file_posix file;
      file.native_handle(found.release());
      response.body().reset(std::move(file), failed_);
    }
    if (!response.body().is_open() || failed_) {
      const HttpReply gone = error_reply(404, "NotFound", "the file is gone");
      co_return co_await send(gone, keep_alive);
    }
    response.prepare_payload();
    const bool written = co_await write(response);
    co_return written&& keep_alive;
  }

  template <class Body>
  Task<bool> write(http::response<Body>& response) {
    http::response_serializer<Body> serializer(response);
    serializer.split(head_only_);
    failed_ = {};
    while (!failed_ && !(head_only_ ? serializer.is_header_done() : serializer.is_done())) {
      stream_.expires_after(kClientTimeout);  // for each piece: a file may be long
      co_await http::async_write_some(stream_, serializer, token());
    }
    co_return !failed_;
  }

  Task<bool> send_events(const HttpReply& reply) {
    HttpReply head = reply;
    head.type = "text/event-stream";
    auto response = make_head<http::empty_body>(head, false);
    http::response_serializer<http::empty_body> serializer(response);
    stream_.expires_after(kClientTimeout);
    co_await http::async_write_header(stream_, serializer, token());
    asio::steady_timer timer(stream_.get_executor());
    while (!failed_ && !head_only_) {
      const std::optional<std::string> text = reply.events();
      if (!text) break;
      if (!text->empty()) {
        stream_.expires_after(kClientTimeout);
        co_await asio::async_write(stream_, asio::buffer(*text), token());
      }
      if (failed_) break;
      timer.expires_after(kEventPoll);
      co_await timer.async_wait(token());
    }
    co_return false;
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  Routes& routes_;
  const ServeOptions& options_;
  beast::error_code failed_;
  bool head_only_ = false;
  Connections& connections_;
  std::optional<Connections::Stranger> stranger_;
  double room_ = 0;  ///< bytes charged to the receive budget
};

}  // namespace

Task<void> serve_connection(asio::ip::tcp::socket socket, Routes& routes,
                            const ServeOptions& options, Connections& connections) {
  Connection connection(std::move(socket), routes, options, connections);
  co_await connection.serve();
}

}  // namespace acinus::service
