#include "core/solve/cg.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::solve {
namespace {

/// What one pass in float may gain: beyond this its recurrence no longer follows the truth.
constexpr double kFloatGain = 1e-4;
/// Passes aim a little below the goal, so that rounding does not cost another pass.
constexpr double kAim = 0.9;
constexpr int kMaxPasses = 12;

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

enum class PassEnd { kReached, kBrokeDown, kOutOfIterations };

/// Iterates on A e = residual from e = 0 until sqrt(r . z) <= goal.
template <class T>
PassEnd run_pass(const Operator& op, std::span<const double> residual, double goal,
                 const CgOptions& options, bool whole, BlockRange range, int& iterations,
                 CgVectors<T>& v) {
  const std::size_t n = residual.size();
  for (auto* a : {&v.correction, &v.residual, &v.direction, &v.preconditioned, &v.product})
    a->resize(n);
  std::ranges::fill(v.correction, T{0});
  for (std::size_t k = 0; k < n; ++k) v.residual[k] = static_cast<T>(residual[k]);
  double rho = op.precondition<T>(v.residual, v.preconditioned);
  if (!std::isfinite(rho)) return PassEnd::kBrokeDown;
  std::ranges::copy(v.preconditioned, v.direction.begin());
  while (std::sqrt(rho) > goal) {
    if (iterations >= options.max_iterations) return PassEnd::kOutOfIterations;
    ++iterations;
    // outside the range the direction is zero
    const double curvature = apply_distributed(op, v.direction, v.product);
    if (!whole) restrict_to(op.system(), range, v.product);
    if (!(curvature > 0)) return PassEnd::kBrokeDown;
    const double next = op.descend<T>(rho / curvature, v.direction, v.product, v.correction,
                                      v.residual, v.preconditioned);
    if (!std::isfinite(next)) return PassEnd::kBrokeDown;
    op.redirect<T>(v.preconditioned, next / rho, v.direction);
    rho = next;
  }
  return PassEnd::kReached;
}

}  // namespace

CgResult solve_cg(const Operator& op, std::span<const double> b, std::span<double> x,
                  const CgOptions& options, CgWorkspace& work, BlockRange range) {
  const std::size_t n = b.size();
  const bool whole = range.first == 0 && range.last >= op.system().block.size();
  work.residual.resize(n);
  work.product.resize(n);
  auto& r = work.residual;
  auto& q = work.product;

  std::ranges::copy(b, r.begin());
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
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    apply_distributed(op, x, q);
    for (std::size_t k = 0; k < n; ++k) r[k] = b[k] - q[k];
    if (!whole) restrict_to(op.system(), range, r);
    const double size = std::sqrt(op.precondition(r, {}));
    result.residual = size / rhs;
    if (result.residual <= options.tolerance) return result;
    double goal = kAim * options.tolerance * rhs;
    if (mixed) goal = std::max(goal, kFloatGain * size);
    const PassEnd end =
        mixed ? run_pass<float>(op, r, goal, options, whole, range, result.iterations, work.single)
              : run_pass<double>(op, r, goal, options, whole, range, result.iterations, work.full);
    if (end == PassEnd::kBrokeDown) {
      if (!mixed) {
        result.status = Status::failed("the matrix is not positive definite");
        return result;
      }
      mixed = false;
      continue;
    }
    if (mixed)
      for (std::size_t k = 0; k < n; ++k) x[k] += static_cast<double>(work.single.correction[k]);
    else
      for (std::size_t k = 0; k < n; ++k) x[k] += work.full.correction[k];
    if (end == PassEnd::kOutOfIterations) {
      result.status = Status::failed("the linear solve did not converge");
      return result;
    }
  }
  return result;
}

}  // namespace acinus::solve
