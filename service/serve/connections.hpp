#pragma once
/// All connections of a service: how many there are of whom nothing is known, and how much is being
/// received. What anybody may make the service hold is bounded, and a flood of strangers does not
/// keep out who comes next.

#include <cstddef>
#include <functional>
#include <list>

namespace acinus::runs {

class Connections {
 public:
  using Close = std::function<void()>;
  using Stranger = std::list<Close>::iterator;

  /// Counts a connection of whom nothing is known. The one that has been so for longest is closed
  /// when there are too many.
  Stranger add_stranger(Close close);
  /// It has shown the token, or it is gone.
  void forget_stranger(Stranger stranger) { strangers_.erase(stranger); }

  /// Makes room for a body, unless those that are being received take too much together already.
  bool take_room(double bytes);
  void give_room(double bytes) { receiving_ -= bytes; }

 private:
  std::list<Close> strangers_;  ///< oldest first
  double receiving_ = 0;        ///< bytes
};

}  // namespace acinus::runs
