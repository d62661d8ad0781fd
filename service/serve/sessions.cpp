#include "service/serve/sessions.hpp"

#include <algorithm>

#include "service/serve/token.hpp"

namespace acinus::service {

std::string Sessions::open() {
  constexpr std::size_t kMostSessions = 256;
  id_.push_back(make_token());
  if (id_.size() > kMostSessions) id_.pop_front();
  return id_.back();
}

bool Sessions::knows(const std::string& id) const {
  return std::ranges::count_if(
             id_, [&](const std::string& known) { return same_secret(id, known); }) > 0;
}

}  // namespace acinus::service
