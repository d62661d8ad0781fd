#include "substances/graph_solve.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

constexpr int kMostIterations = 200;
/// Least reduction of the first residual: slow changes behind membranes add up over steps, while
/// faces that are held fixed make the right-hand side large. Not below round-off.
constexpr double kLeastReduction = 1e-3, kRoundOff = 1e-13;

/// y = A x
void multiply(const GraphSystem& s, std::span<const double> diagonal, std::span<const double> x,
              std::span<double> y) {
  for (std::size_t i = 0; i < s.n(); ++i) {
    double sum = diagonal[i] * x[i];
    for (std::size_t l = s.start[i]; l < s.start[i + 1]; ++l)
      sum -= s.link[l] * x[static_cast<std::size_t>(s.to[l])];
    y[i] = sum;
  }
}

/// Sum of f(first, count) over blocks of numbers: the error of long sums would be seen in amounts.
template <class F>
double sum_blocks(std::size_t n, const F& f) {
  constexpr std::size_t kBlock = 1024;
  double sum = 0;
  for (std::size_t first = 0; first < n; first += kBlock)
    sum += f(first, std::min(kBlock, n - first));
  return sum;
}

LinkGraph in_single_precision(const GraphSystem& s) {
  LinkGraph g;
  g.start = s.start;
  g.to = s.to;
  g.link.assign(s.link.begin(), s.link.end());
  g.own.assign(s.own.begin(), s.own.end());
  return g;
}

}  // namespace

void set_links(std::size_t n, std::span<const GraphLink> links, GraphSystem& s) {
  s.start.assign(n + 1, 0);
  for (const GraphLink& l : links) {
    ++s.start[static_cast<std::size_t>(l.a) + 1];
    ++s.start[static_cast<std::size_t>(l.b) + 1];
  }
  std::partial_sum(s.start.begin(), s.start.end(), s.start.begin());
  s.to.resize(2 * links.size());
  s.link.resize(2 * links.size());
  std::vector<std::size_t> next(s.start.begin(), s.start.end() - 1);
  const auto put = [&](int from, int to, double value) {
    const std::size_t at = next[static_cast<std::size_t>(from)]++;
    s.to[at] = to;
    s.link[at] = value;
  };
  for (const GraphLink& l : links) {
    put(l.a, l.b, l.value);
    put(l.b, l.a, l.value);
  }
}

SolveResult GraphSolver::solve(const GraphSystem& s, double tolerance, std::span<double> x) {
  const std::size_t n = s.n();
  SolveResult result;
  const double norm = std::sqrt(dot_numbers(s.rhs, s.rhs));
  if (!(norm > 0)) {
    std::ranges::fill(x, 0.0);
    result.converged = true;
    return result;
  }
  diagonal_ = s.own;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t l = s.start[i]; l < s.start[i + 1]; ++l) diagonal_[i] += s.link[l];
  aggregates_.set(in_single_precision(s));
  r_.resize(n);
  q_.resize(n);
  p_.assign(n, 0.0);
  rf_.resize(n);
  z_.resize(n);
  multiply(s, diagonal_, x, q_);
  for (std::size_t i = 0; i < n; ++i) r_[i] = s.rhs[i] - q_[i];
  double rr = dot_numbers(r_, r_), rz_before = 0;
  const double wanted =
      std::min(tolerance * norm, std::max(kLeastReduction * std::sqrt(rr), kRoundOff * norm));
  while (std::sqrt(rr) > wanted && result.iterations < kMostIterations) {
    for (std::size_t i = 0; i < n; ++i) rf_[i] = static_cast<float>(r_[i] / norm);
    aggregates_.apply(rf_, z_);
    double rz = 0;
    for (std::size_t i = 0; i < n; ++i) rz += r_[i] * static_cast<double>(z_[i]);
    const double beta = result.iterations == 0 ? 0 : rz / rz_before;
    rz_before = rz;
    for (std::size_t i = 0; i < n; ++i) p_[i] = static_cast<double>(z_[i]) + beta * p_[i];
    multiply(s, diagonal_, p_, q_);
    const double pq = dot_numbers(p_, q_);
    if (!(pq > 0)) break;
    const double alpha = rz / pq;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p_[i];
      r_[i] -= alpha * q_[i];
    }
    rr = dot_numbers(r_, r_);
    ++result.iterations;
  }
  result.residual = std::sqrt(rr) / norm;
  result.converged = result.residual <= tolerance;
  for (double& value : x) value = std::max(value, 0.0);  // cut as in Solver::solve
  // Links cancel in the sum of A x.
  const std::span<const double> own = s.own, rhs = s.rhs, found = x;
  const double factor =
      sum_blocks(n, [&](std::size_t first,
                        std::size_t count) { return sum_numbers(rhs.subspan(first, count)); }) /
      sum_blocks(n, [&](std::size_t first, std::size_t count) {
        return dot_numbers(own.subspan(first, count), found.subspan(first, count));
      });
  if (factor > 0.5 && factor < 2)
    for (double& value : x) value *= factor;
  return result;
}

}  // namespace acinus::substances
