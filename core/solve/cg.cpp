#include "core/solve/cg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/threads.hpp"

namespace acinus::solve {
namespace {

/// What one pass in float may gain: beyond this its recurrence no longer follows the truth.
constexpr double kFloatGain = 1e-4;
/// Passes aim a little below the goal, so that rounding does not cost another pass.
constexpr double kAim = 0.9;
constexpr int kMaxPasses = 20;
/// A pass that leaves more than this share of the residual has reached what its numbers can do.
constexpr double kLeastGain = 0.5;
/// A solve that took this many iterations is likely to take as many more.
constexpr int kMergeAfter = 16;
/// Relative residual at which a solve that rounding stopped counts as solved all the same.
constexpr double kHarmless = 1e-3;

/// Clears the entries outside the range.
template <class T>
void restrict_to(const System& s, BlockRange range, std::vector<T>& v) {
  const std::size_t n = s.block.size();
  const std::size_t first = range.first < n ? s.block[range.first].first_row : s.n_row;
  const std::size_t last = range.last < n ? s.block[range.last].first_row : s.n_row;
  std::fill_n(v.begin(), first * kPointStride, T{0});
  std::fill(v.begin() + static_cast<std::ptrdiff_t>(last * kPointStride), v.end(), T{0});
}

/// y = A x over all ranks; returns x . y.
double apply_distributed(const Operator& op, std::span<double> x, std::span<double> y) {
  op.system().halo.update(x);
  const double product = op.apply<double>(x, y);
  op.system().halo.add_back(y);
  return product;
}
double apply_distributed(const Operator& op, std::span<float> x, std::span<float> y) {
  return op.apply<float>(x, y);  // one rank: more are refused before a run starts
}

/// A squared norm: a number, and not negative.
bool is_size(double rho) { return std::isfinite(rho) && rho >= 0; }

enum class PassEnd { kReached, kBrokeDown, kOutOfIterations };

/// Iterates on A e = residual / size from e = 0 until sqrt(r . z) <= goal. The scale keeps floats
/// away from underflow.
template <class T>
PassEnd run_pass(Operator& op, std::span<const double> residual, double size, double goal,
                 const CgOptions& options, bool whole, BlockRange range, const CoarseSpace* coarse,
                 int& iterations, CgVectors<T>& v) {
  const std::size_t n = residual.size();
  for (auto* a : {&v.correction, &v.residual, &v.direction, &v.preconditioned, &v.product})
    a->resize(n);
  for_each_number(n, [&](std::size_t k) {
    v.correction[k] = 0;
    v.residual[k] = static_cast<T>(residual[k] / size);
  });
  auto add_coarse = [&](double diagonal) {
    return coarse ? diagonal + coarse->add(v.residual, v.preconditioned) : diagonal;
  };
  double size2 = op.precondition<T>(v.residual, v.preconditioned);
  double rho = add_coarse(size2);
  if (!is_size(rho)) return PassEnd::kBrokeDown;
  for_each_number(n, [&](std::size_t k) { v.direction[k] = v.preconditioned[k]; });
  while (std::sqrt(size2) > goal) {
    if (iterations >= options.max_iterations) return PassEnd::kOutOfIterations;
    ++iterations;
    if (std::is_same_v<T, float> && iterations == kMergeAfter) op.merge_links();
    // outside the range the direction is zero
    const double curvature = apply_distributed(op, v.direction, v.product);
    if (!whole) restrict_to(op.system(), range, v.product);
    if (!(curvature > 0)) return PassEnd::kBrokeDown;
    size2 = op.descend<T>(rho / curvature, v.direction, v.product, v.correction, v.residual,
                          v.preconditioned);
    const double next = add_coarse(size2);
    if (!is_size(size2) || !is_size(next)) return PassEnd::kBrokeDown;
    op.redirect<T>(v.preconditioned, next / rho, v.direction);
    rho = next;
  }
  return PassEnd::kReached;
}

/// x += size * correction.
template <class T>
void add_correction(double size, const std::vector<T>& correction, std::span<double> x) {
  for_each_number(x.size(),
                  [&](std::size_t k) { x[k] += size * static_cast<double>(correction[k]); });
}

}  // namespace

CgResult solve_cg(Operator& op, std::span<const double> b, std::span<double> x,
                  const CgOptions& options, CgWorkspace& work, BlockRange range,
                  const CoarseSpace* coarse) {
  const std::size_t n = b.size();
  const bool whole = range.first == 0 && range.last >= op.system().block.size();
  work.residual.resize(n);
  work.product.resize(n);
  auto& r = work.residual;
  auto& q = work.product;

  for_each_number(n, [&](std::size_t k) { r[k] = b[k]; });
  if (!whole) {
    // What the rest does to the range belongs to the right-hand side of this smaller system.
    std::vector<double> inside(x.begin(), x.end()), rest(n);
    restrict_to(op.system(), range, inside);
    for (std::size_t k = 0; k < n; ++k) rest[k] = x[k] - inside[k];
    apply_distributed(op, rest, q);
    for (std::size_t k = 0; k < n; ++k) r[k] -= q[k];
    restrict_to(op.system(), range, r);
  }
  const double rhs = std::sqrt(op.precondition(r, {}));
  CgResult result;
  if (!std::isfinite(rhs)) {
    result.status = Status::failed("the right-hand side is not finite");
    return result;
  }
  if (rhs == 0) {
    if (whole) {
      std::ranges::fill(x, 0.0);
    } else {
      std::vector<double> inside(x.begin(), x.end());
      restrict_to(op.system(), range, inside);
      for (std::size_t k = 0; k < n; ++k) x[k] -= inside[k];
    }
    return result;
  }

  bool mixed = options.precision == Precision::kMixed && whole;
  bool stopped = false;
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0;; ++pass) {
    apply_distributed(op, x, q);
    for_each_number(n, [&](std::size_t k) { r[k] = b[k] - q[k]; });
    if (!whole) restrict_to(op.system(), range, r);
    const double rho = op.precondition(r, {}), size = std::sqrt(rho);
    if (!is_size(rho)) {
      result.status = Status::failed("the matrix is not positive definite");
      return result;
    }
    result.residual = size / rhs;
    if (result.residual <= options.tolerance) return result;
    if (stopped || pass >= kMaxPasses) {
      result.status = Status::failed("the linear solve did not converge");
      return result;
    }
    if (size > kLeastGain * before) {
      if (!mixed && result.residual <= kHarmless) return result;  // as good as doubles can do
      mixed = false;
    }
    before = size;
    double goal = kAim * options.tolerance * rhs / size;
    if (mixed) goal = std::max(goal, kFloatGain);
    const PassEnd end = mixed ? run_pass<float>(op, r, size, goal, options, whole, range, coarse,
                                                result.iterations, work.single)
                              : run_pass<double>(op, r, size, goal, options, whole, range, coarse,
                                                 result.iterations, work.full);
    if (end == PassEnd::kBrokeDown) {
      if (!mixed) {
        result.status = Status::failed("the matrix is not positive definite");
        return result;
      }
      mixed = false;
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    if (mixed)
      add_correction(size, work.single.correction, x);
    else
      add_correction(size, work.full.correction, x);
    stopped = end == PassEnd::kOutOfIterations;
  }
}

}  // namespace acinus::solve
