#pragma once
/// What waits without a thread: coroutines on the loop of the service.

#include <utility>  // Boost 1.74's awaitable.hpp needs it and does not include it

#include <boost/asio/awaitable.hpp>

namespace acinus::runs {

template <class T>
using Task = boost::asio::awaitable<T>;

}  // namespace acinus::runs
