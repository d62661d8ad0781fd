#pragma once
/// Limits over all connections of a service: unauthenticated connections and bytes being received.
/// Flooding therefore neither exhausts memory nor keeps out later clients.

#include <cstddef>
#include <functional>
#include <list>

namespace acinus::service {

/// Counters of unauthenticated connections and of bytes being received.
class Connections {
 public:
  using Close = std::function<void()>;
  using Stranger = std::list<Close>::iterator;

  /// Registers an unauthenticated connection. Beyond the limit the oldest one is closed.
  Stranger add_stranger(Close close);
  /// Removes a connection that has authenticated or closed.
  void forget_stranger(Stranger stranger) { strangers_.erase(stranger); }

  /// Charges a body to the receive budget.
  /// @return false if the budget is exhausted
  bool take_room(double bytes);
  void give_room(double bytes) { receiving_ -= bytes; }

 private:
  std::list<Close> strangers_;  ///< oldest first
  double receiving_ = 0;        ///< bytes
};

}  // namespace acinus::service
