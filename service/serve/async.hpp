#pragma once
/// Coroutines on the event loop of the service, which wait without a thread.

#include <boost/asio/awaitable.hpp>

namespace acinus::service {

template <class T>
using Task = boost::asio::awaitable<T>;

}  // namespace acinus::service
