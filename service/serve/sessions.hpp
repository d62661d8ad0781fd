#pragma once
/// Browsers that have logged in. What a browser keeps is not the token: cookies go to every port of
/// a machine.

#include <deque>
#include <string>

namespace acinus::runs {

class Sessions {
 public:
  /// A new id. The oldest session ends when there are too many.
  std::string open();
  bool knows(const std::string& id) const;

 private:
  std::deque<std::string> id_;
};

}  // namespace acinus::runs
