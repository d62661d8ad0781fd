#include "solve/operator.hpp"

namespace acinus::solve {

std::array<std::span<float>, 5> Operator::float_vectors() const {
  const std::size_t n = system_->n_dof();
  auto* const bytes = reinterpret_cast<std::byte*>(scratch_.data());
  auto* const first =
      reinterpret_cast<float*>(bytes + system_->n_row * kLanes * sizeof(Packed<double>));
  std::array<std::span<float>, 5> vectors;
  for (std::size_t k = 0; k < vectors.size(); ++k) vectors[k] = {first + k * n, n};
  return vectors;
}

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
