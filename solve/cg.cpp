#include "solve/cg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/parallel/arrays.hpp"
#include "core/parallel/stop.hpp"

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

/// A squared norm: a number, and not negative.
bool is_size(double rho) { return std::isfinite(rho) && rho >= 0; }

enum class PassEnd { kReached, kBrokeDown, kOutOfIterations, kAskedToStop };

/// What a pass starts from and where it ends.
struct PassPlan {
  double size = 1;  ///< of the residual: the scale keeps floats away from underflow
  double goal = 0;  ///< on sqrt(r . z), after scaling
  int max_iterations = 0;
  const CoarseSpace* coarse = nullptr;
};

/// Iterates on A e = residual / size from e = 0 until the goal.
template <class T>
PassEnd run_pass(Operator& op, std::span<const double> residual, const PassPlan& plan,
                 int& iterations, CgVectors<T>& v) {
  const std::size_t n = residual.size();
  for (auto* a : {&v.correction, &v.residual, &v.direction, &v.preconditioned, &v.product})
    set_size(*a, n);
  for_each_own_number(op.system(), [&](std::size_t k) {
    v.correction[k] = 0;
    v.residual[k] = static_cast<T>(residual[k] / plan.size);
  });
  auto add_coarse = [&](double diagonal) {
    return plan.coarse ? diagonal + plan.coarse->add(v.residual, v.preconditioned) : diagonal;
  };
  double size2 = op.precondition<T>(v.residual, v.preconditioned);
  double rho = add_coarse(size2);
  if (!is_size(rho)) return PassEnd::kBrokeDown;
  for_each_own_number(op.system(), [&](std::size_t k) { v.direction[k] = v.preconditioned[k]; });
  while (std::sqrt(size2) > plan.goal) {
    if (iterations >= plan.max_iterations) return PassEnd::kOutOfIterations;
    if (stop_requested()) return PassEnd::kAskedToStop;
    ++iterations;
    if (std::is_same_v<T, float> && iterations == kMergeAfter) op.merge_links();
    const double curvature = op.apply<T>(v.direction, v.product);
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
void add_correction(const System& s, double size, const std::vector<T>& correction,
                    std::span<double> x) {
  for_each_own_number(s, [&](std::size_t k) { x[k] += size * static_cast<double>(correction[k]); });
}

/// r = b - A x; returns its squared norm.
double find_residual(const Operator& op, std::span<const double> b, std::span<const double> product,
                     CgWorkspace& work) {
  for_each_own_number(op.system(), [&](std::size_t k) { work.residual[k] = b[k] - product[k]; });
  return op.precondition(work.residual, {});
}

/// One pass in the numbers asked for, added to x unless it broke down.
PassEnd improve(Operator& op, bool in_float, const PassPlan& plan, CgWorkspace& work,
                std::span<double> x, int& iterations) {
  const auto run = [&](auto& vectors) {
    const PassEnd end = run_pass(op, work.residual, plan, iterations, vectors);
    if (end != PassEnd::kBrokeDown) add_correction(op.system(), plan.size, vectors.correction, x);
    return end;
  };
  return in_float ? run(work.single) : run(work.full);
}

CgResult fail(CgResult result, const char* why) {
  result.status = Status::failed(why);
  return result;
}

constexpr const char* kIndefinite = "the matrix is not positive definite";

}  // namespace

CgResult solve_cg(Operator& op, std::span<const double> b, std::span<double> x,
                  const CgOptions& options, CgWorkspace& work, const CoarseSpace* coarse,
                  std::span<const double> product) {
  copy_numbers(b, work.residual);
  set_size(work.product, b.size());
  const double rhs = std::sqrt(op.precondition(work.residual, {}));
  CgResult result;
  if (!std::isfinite(rhs)) return fail(result, "the right-hand side is not finite");
  if (rhs == 0) {
    std::ranges::fill(x, 0.0);
    return result;
  }

  bool mixed = options.precision == Precision::kMixed;
  bool stopped = false;
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0;; ++pass) {
    if (product.empty()) {
      op.apply<double>(x, work.product);
      product = work.product;
    }
    const double rho = find_residual(op, b, product, work), size = std::sqrt(rho);
    product = {};
    if (!is_size(rho)) return fail(result, kIndefinite);
    result.residual = size / rhs;
    if (result.residual <= options.tolerance) return result;
    if (stopped || pass >= kMaxPasses) return fail(result, "the linear solve did not converge");
    if (size > kLeastGain * before) {
      if (!mixed && result.residual <= kHarmless) return result;  // as good as doubles can do
      mixed = false;
    }
    before = size;
    const double goal = kAim * options.tolerance * rhs / size;
    const PassPlan plan{size, mixed ? std::max(goal, kFloatGain) : goal, options.max_iterations,
                        coarse};
    const PassEnd end = improve(op, mixed, plan, work, x, result.iterations);
    if (end == PassEnd::kAskedToStop) return fail(result, "asked to stop");
    stopped = end == PassEnd::kOutOfIterations;
    if (end != PassEnd::kBrokeDown) continue;
    if (!mixed) return fail(result, kIndefinite);
    mixed = false;
    before = std::numeric_limits<double>::infinity();
  }
}

}  // namespace acinus::solve
