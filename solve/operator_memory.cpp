#include "solve/operator.hpp"

namespace acinus::solve {

void Operator::release() {
  merge_ = {};
  merger_ = {};
  merged_ = false;
  scratch_ = RowVector<Line>();  // assigning {} would keep the memory
}

std::size_t Operator::memory() const {
  std::size_t bytes = memory_of(range_of_row_) + merger_.memory() + merge_.pairs.memory();
  for (const ThreadRange& range : range_) {
    for (const ShareLists* lists : {&range.link, &range.point_link, &range.single, &range.pair})
      for (const LargeVector<Share>& list : *lists) bytes += memory_of(list);
    bytes += memory_of(range.external) + memory_of(range.external_point);
  }
  return bytes;
}

}  // namespace acinus::solve
