#include "solve/blocks.hpp"

#include "core/error.hpp"

namespace acinus::solve {

void Blocks::append(Block b) {
  const BlockPattern& p = *b.pattern;
  b.first_row = end_.first_row;
  b.first_shape = end_.first_shape;
  b.first_spring = end_.first_spring;
  b.first_hinge = end_.first_hinge;
  b.first_face = end_.first_face;
  b.first_beam = end_.first_beam;
  end_.first_row += static_cast<std::size_t>(p.n_point);
  if (p.has_shape()) end_.first_shape += static_cast<std::size_t>(p.n_point);
  end_.first_spring += p.spring.size();
  end_.first_hinge += p.wing.size();
  end_.first_face += p.face.size();
  end_.first_beam += p.beam.size();
  if (n_equal_ > 0) return back_.push_back(b);
  block_of_row_.resize(end_.first_row, static_cast<int>(front_.size()));
  front_.push_back(b);
}

void Blocks::append_points(const BlockPattern& pattern, std::size_t n) {
  ACINUS_ASSERT(n_equal_ == 0 && pattern.n_point == 1 && pattern.spring.empty());
  equal_ = end_;
  equal_.pattern = &pattern;
  n_equal_ = n;
  end_.first_row += n;
}

std::size_t Blocks::memory() const {
  return (front_.capacity() + back_.capacity()) * sizeof(Block) +
         block_of_row_.capacity() * sizeof(int);
}

}  // namespace acinus::solve
