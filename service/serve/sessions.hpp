#pragma once
/// Login sessions of browsers. The cookie holds a session id instead of the token, since cookies
/// are sent to all ports of a machine.

#include <deque>
#include <string>

namespace acinus::service {

/// Set of open login sessions, bounded in number.
class Sessions {
 public:
  /// New session id. The oldest session ends beyond the limit.
  std::string open();
  bool knows(const std::string& id) const;

 private:
  std::deque<std::string> id_;
};

}  // namespace acinus::service
