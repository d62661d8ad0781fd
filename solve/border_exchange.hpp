#pragma once
/// Cells in contact across processes. Both processes of such a contact know it, so each knows what
/// the other one needs without asking.

#include <array>
#include <span>
#include <vector>

#include "solve/system.hpp"

namespace acinus::solve {

/// Own cell and a cell of another process in contact.
using BorderPair = std::array<LaneIndex, 2>;

/// Own cells that touch cells of other processes, whose values are sent, and those cells: by
/// process, ascending.
struct BorderExchange {
  ExchangePlan plan;  ///< of `send` and `receive`
  std::vector<LaneIndex> send, receive;
};

/// Plans an exchange of the cells of pairs in contact. @param pairs  in any order, repeated or not
BorderExchange plan_border_exchange(const Ownership& ownership, std::span<const BorderPair> pairs);

}  // namespace acinus::solve
