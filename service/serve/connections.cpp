#include "service/serve/connections.hpp"

#include <utility>

namespace acinus::service {
namespace {

constexpr std::size_t kMostStrangers = 512;
constexpr double kMostBytesReceived = 64e6;  ///< bytes in all connections together

}  // namespace

Connections::Stranger Connections::add_stranger(Close close) {
  if (strangers_.size() >= kMostStrangers) {
    // It goes when it notices; until then it stands at the end, and the next one is another.
    if (const Close close_oldest = std::exchange(strangers_.front(), nullptr)) close_oldest();
    strangers_.splice(strangers_.end(), strangers_, strangers_.begin());
  }
  return strangers_.insert(strangers_.end(), std::move(close));
}

bool Connections::take_room(double bytes) {
  // One alone may be larger: --max-body bounds it.
  if (receiving_ > 0 && receiving_ + bytes > kMostBytesReceived) return false;
  receiving_ += bytes;
  return true;
}

}  // namespace acinus::service
