#include "solve/border_exchange.hpp"

#include <utility>

#include "core/sort_unique.hpp"

namespace acinus::solve {

BorderExchange plan_border_exchange(const Ownership& ownership, std::span<const BorderPair> pairs) {
  std::vector<std::pair<int, LaneIndex>> give, get;  // by process
  for (const auto& [own, other] : pairs) {
    const int rank = ownership.owner[other / kLanes];
    give.emplace_back(rank, own);
    get.emplace_back(rank, other);
  }
  sort_unique(give);
  sort_unique(get);
  BorderExchange border;
  for (std::size_t g = 0, k = 0; k < get.size();) {
    ExchangePlan::Peer peer{get[k].first, border.send.size(), 0, border.receive.size(), 0};
    for (; k < get.size() && get[k].first == peer.rank; ++k)
      border.receive.push_back(get[k].second);
    for (; g < give.size() && give[g].first == peer.rank; ++g)
      border.send.push_back(give[g].second);
    peer.send_end = border.send.size();
    peer.receive_end = border.receive.size();
    border.plan.peer.push_back(peer);
  }
  return border;
}

}  // namespace acinus::solve
