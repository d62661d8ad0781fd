#pragma once
/// What waits without a thread: coroutines on the loop of the service.

#include <boost/asio/awaitable.hpp>

namespace acinus::runs {

template <class T>
using Task = boost::asio::awaitable<T>;

}  // namespace acinus::runs
