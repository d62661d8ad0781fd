#include "solve/coarse.hpp"

#include <utility>

#include "core/numbers/exact_sum.hpp"
#include "core/parallel/threads.hpp"
#include "solve/coarse_kernels.hpp"

namespace acinus::solve {

void CoarseSpace::prepare(const Operator& op, const CoarseInput& in) {
  system_ = &op.system();
  matrix_.assemble(op, in);
  run_.clear();
  for (std::size_t c = 0; c < matrix_.n_own(); ++c) {  // in the order of lanes
    const std::size_t b = matrix_.lane_of(c) / kLanes;
    if (run_.empty() || run_.back().block != b) run_.push_back({b, c, c});
    ++run_.back().last;
  }
}

/// Chebyshev iteration on E x = load from x = 0, preconditioned by the diagonal entries.
void CoarseSpace::apply_polynomial() const {
  constexpr double kSmallest = kLargest / kSpread, kCenter = 0.5 * (kLargest + kSmallest),
                   kHalf = 0.5 * (kLargest - kSmallest), kRatio = kCenter / kHalf;
  const std::size_t n = matrix_.n_own();
  const bool shared = worth_threads(system_->n_row);
  for (auto* v : {&sum_, &residual_}) v->resize(n);
  for (auto* v : {&direction_, &next_}) v->resize(matrix_.n_cell());
  for_each_index(n, shared, [&](std::size_t c) {
    residual_[c] = load_[c];
    direction_[c] = sum_[c] = matrix_.invert_diagonal(c, load_[c]) / kCenter;
  });
  double rho = 1 / kRatio;
  for (int k = 1; k < kDegree; ++k) {
    matrix_.fetch(direction_);
    const double after = 1 / (2 * kRatio - rho);
    for_each_index(n, shared, [&](std::size_t c) {
      residual_[c] -= matrix_.multiply(c, direction_);
      next_[c] = after * rho * direction_[c] +
                 2 * after / kHalf * matrix_.invert_diagonal(c, residual_[c]);
      sum_[c] += next_[c];
    });
    std::swap(direction_, next_);
    rho = after;
  }
}

template <class T>
double CoarseSpace::add_of(std::span<const T> r, std::span<T> z) const {
  const System& s = *system_;
  const std::size_t n = matrix_.n_own();
  const bool shared = worth_threads(s.n_row);
  load_.resize(n);
  const auto for_each_block = [&](const auto& f) {
    for_each_index(run_.size(), shared,
                   [&](std::size_t k) { f(s.block[run_[k].block], run_[k].first, run_[k].last); });
  };
  for_each_block([&](const Block& b, std::size_t begin, std::size_t end) {
    const std::size_t at = b.first_row * kPointStride;
    double out[6 * kLanes];
    restrict_block(b.pattern->n_point, matrix_.arm().data() + at, r.data() + at, out);
    for (std::size_t c = begin; c < end; ++c)
      for (int m = 0; m < 6; ++m) load_[c][m] = out[m * kLanes + matrix_.lane_of(c) % kLanes];
  });
  apply_polynomial();
  for_each_block([&](const Block& b, std::size_t begin, std::size_t end) {
    const std::size_t at = b.first_row * kPointStride;
    double in[6 * kLanes] = {};
    for (std::size_t c = begin; c < end; ++c)
      for (int m = 0; m < 6; ++m) in[m * kLanes + matrix_.lane_of(c) % kLanes] = sum_[c][m];
    prolong_block(b.pattern->n_point, matrix_.arm().data() + at, in, z.data() + at);
  });
  ExactSum product;
  for (std::size_t c = 0; c < n; ++c) product.add(load_[c].dot(sum_[c]));
  s.ownership.ranks.sum(std::span(&product, 1));
  return product.value();
}

double CoarseSpace::add(std::span<const float> r, std::span<float> z) const {
  return add_of<float>(r, z);
}
double CoarseSpace::add(std::span<const double> r, std::span<double> z) const {
  return add_of<double>(r, z);
}

std::size_t CoarseSpace::memory() const {
  std::size_t bytes = matrix_.memory() + memory_of(run_);
  for (const auto* v : {&load_, &sum_, &residual_, &direction_, &next_}) bytes += memory_of(*v);
  return bytes;
}

}  // namespace acinus::solve
