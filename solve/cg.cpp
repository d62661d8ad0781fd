#include "solve/cg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/parallel/make_room.hpp"
#include "core/parallel/stop.hpp"

namespace acinus::solve {
namespace {

/// Largest reduction of the residual in one pass in float: beyond it the recurrence drifts from the
/// true residual.
constexpr double kLargestFloatReduction = 1e-4;
/// Share of the tolerance that passes aim at, so that rounding does not cost another pass.
constexpr double kGoalShare = 0.9;
constexpr int kMaxPasses = 20;
/// Largest share of the residual that a useful pass leaves: above it, the pass has reached the
/// limit of its precision.
constexpr double kLargestUsefulShare = 0.5;
/// Expected iterations from which merging contacts pays: it costs as much as 10 to 25 products
/// save.
constexpr int kPayingIterations = 20;
/// Iterations after which it pays where fewer are expected: a solve that took so many is likely to
/// take as many more.
constexpr int kMergingIterations = 32;
/// Relative residual at which a solve that rounding stopped still counts as converged.
constexpr double kRoundingTolerance = 1e-3;

/// True for a valid squared norm: finite and not negative.
bool is_size(double rho) { return std::isfinite(rho) && rho >= 0; }

enum class PassEnd { kReached, kBrokeDown, kOutOfIterations, kAskedToStop };

/// Start and end of one pass.
struct PassPlan {
  double size = 1;  ///< norm of the residual: scaling by it keeps floats away from underflow
  double goal = 0;  ///< on sqrt(r . z), after scaling
  int max_iterations = 0;
  int merging_iteration = 0;  ///< merges contacts then, in float
  const CoarseSpace* coarse = nullptr;
};

/// Vectors of one pass.
template <class T>
struct CgVectors {
  std::span<T> correction, residual, direction, preconditioned, product;
};

/// Vectors of a pass in float, in memory of the operator.
CgVectors<float> float_vectors(const Operator& op) {
  const auto [correction, residual, direction, preconditioned, product] = op.float_vectors();
  return {correction, residual, direction, preconditioned, product};
}

/// Vectors of a pass in double.
CgVectors<double> double_vectors(std::size_t n, CgWorkspace& work) {
  for (RowVector<double>& v : work.vector) set_size(v, n);
  auto& [correction, residual, direction, preconditioned, product] = work.vector;
  return {correction, residual, direction, preconditioned, product};
}

/// Iterates on A e = residual / size from e = 0 to the goal.
template <class T>
PassEnd run_pass(Operator& op, std::span<const double> residual, const PassPlan& plan,
                 int& iterations, const CgVectors<T>& v) {
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
    if (std::is_same_v<T, float> && iterations == plan.merging_iteration) op.merge_links();
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
void add_correction(const System& s, double size, std::span<const T> correction,
                    std::span<double> x) {
  for_each_own_number(s, [&](std::size_t k) { x[k] += size * static_cast<double>(correction[k]); });
}

/// Computes the residual b - A x.
void compute_residual(const CgProblem& problem, std::span<const double> x, CgWorkspace& work) {
  set_size(work.product, problem.b.size());
  problem.op.apply<double>(x, work.product);
  for_each_own_number(problem.op.system(),
                      [&](std::size_t k) { work.residual[k] = problem.b[k] - work.product[k]; });
}

/// Runs one pass in the given precision and adds its correction to x unless it broke down.
PassEnd improve(Operator& op, bool in_float, const PassPlan& plan, CgWorkspace& work,
                std::span<double> x, CgResult& result) {
  const auto run = [&]<class T>(const CgVectors<T>& v) {
    const PassEnd end = run_pass(op, work.residual, plan, result.iterations, v);
    if (end != PassEnd::kBrokeDown) add_correction<T>(op.system(), plan.size, v.correction, x);
    return end;
  };
  ++(in_float ? result.float_passes : result.double_passes);
  return in_float ? run(float_vectors(op)) : run(double_vectors(x.size(), work));
}

CgResult fail(CgResult result, const char* why) {
  result.status = Status::failed(why);
  return result;
}

constexpr const char* kIndefinite = "the matrix is not positive definite";

}  // namespace

CgResult solve_cg(const CgProblem& problem, std::span<double> x, const CgOptions& options,
                  CgWorkspace& work) {
  const Operator& op = problem.op;
  set_size(work.residual, problem.b.size());
  for_each_own_number(op.system(), [&](std::size_t k) { work.residual[k] = problem.b[k]; });
  work.load = std::sqrt(op.precondition(work.residual, {}));
  CgResult result;
  if (!std::isfinite(work.load)) return fail(result, "the right-hand side is not finite");
  if (work.load == 0) {
    for_each_own_number(op.system(), [&](std::size_t k) { x[k] = 0; });
    return result;
  }
  compute_residual(problem, x, work);
  return continue_cg(problem, x, options, work);
}

CgResult continue_cg(const CgProblem& problem, std::span<double> x, const CgOptions& options,
                     CgWorkspace& work) {
  Operator& op = problem.op;
  CgResult result;
  bool mixed = options.precision == Precision::kMixed;
  bool stopped = false;
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0;; ++pass) {
    if (pass > 0) compute_residual(problem, x, work);
    const double rho = op.precondition(work.residual, {}), size = std::sqrt(rho);
    if (!is_size(rho)) return fail(result, kIndefinite);
    result.residual = size / work.load;
    if (result.residual <= options.tolerance) return result;
    if (stopped || pass >= kMaxPasses) return fail(result, "the linear solve did not converge");
    if (size > kLargestUsefulShare * before) {
      if (!mixed && result.residual <= kRoundingTolerance)
        return result;  // as good as doubles can do
      mixed = false;
    }
    before = size;
    const double goal = kGoalShare * options.tolerance * work.load / size;
    const PassPlan plan{
        size, mixed ? std::max(goal, kLargestFloatReduction) : goal, options.max_iterations,
        problem.expected_iterations < kPayingIterations ? kMergingIterations : 1, problem.coarse};
    const PassEnd end = improve(op, mixed, plan, work, x, result);
    if (end == PassEnd::kAskedToStop) return fail(result, "asked to stop");
    stopped = end == PassEnd::kOutOfIterations;
    if (end != PassEnd::kBrokeDown) continue;
    if (!mixed) return fail(result, kIndefinite);
    mixed = false;
    before = std::numeric_limits<double>::infinity();
  }
}

}  // namespace acinus::solve
