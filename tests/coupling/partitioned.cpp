#include "tests/coupling/partitioned.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace acinus::coupling {
namespace {

/// Conjugate gradients on the unknowns [first, last); the others keep what they have and push.
class PartSolve {
 public:
  PartSolve(const solve::Operator& op, std::span<const double> b, std::size_t first,
            std::size_t last)
      : op_(op), b_(b), first_(first), last_(last) {}

  solve::CgResult run(double tolerance, int max_iterations, std::span<double> x) const {
    solve::CgResult result;
    std::vector<double> others(x.begin(), x.end());
    std::fill(others.begin() + at(first_), others.begin() + at(last_), 0.0);
    std::vector<double> r(b_.begin(), b_.end());
    subtract(others, r);
    const double rhs = size_of(r);
    subtract_part(x, r);
    std::vector<double> z(x.size()), p(x.size(), 0.0), product(x.size());
    double before = 0;
    while (size_of(r) > tolerance * rhs) {
      if (++result.iterations > max_iterations) {
        result.status = Status::failed("a part did not converge");
        break;
      }
      op_.precondition(r, z);
      const double rho = op_.dot(r, z);
      for (std::size_t k = first_; k < last_; ++k)
        p[k] = z[k] + (before > 0 ? rho / before : 0) * p[k];
      before = rho;
      op_.apply(p, product);
      const double step = rho / op_.dot(p, product);
      for (std::size_t k = first_; k < last_; ++k) {
        x[k] += step * p[k];
        r[k] -= step * product[k];
      }
    }
    return result;
  }

 private:
  static std::ptrdiff_t at(std::size_t k) { return static_cast<std::ptrdiff_t>(k); }
  double size_of(const std::vector<double>& r) const {
    std::vector<double> z(r.size());
    op_.precondition(r, z);
    return std::sqrt(op_.dot(r, z));
  }
  /// r -= A x within the part, 0 outside.
  void subtract(std::vector<double>& x, std::vector<double>& r) const {
    std::vector<double> product(x.size());
    op_.apply(x, product);
    for (std::size_t k = 0; k < r.size(); ++k)
      r[k] = k >= first_ && k < last_ ? r[k] - product[k] : 0;
  }
  void subtract_part(std::span<const double> x, std::vector<double>& r) const {
    std::vector<double> own(x.size(), 0.0);
    std::copy(x.begin() + at(first_), x.begin() + at(last_), own.begin() + at(first_));
    subtract(own, r);
  }

  const solve::Operator& op_;
  std::span<const double> b_;
  std::size_t first_, last_;
};

}  // namespace

solve::CgResult solve_partitioned(solve::Operator& op, std::span<const double> b,
                                  std::span<double> x, std::size_t n_dcm_block,
                                  const solve::CgOptions& options, solve::CgWorkspace& work) {
  constexpr int kMaxExchanges = 2000;
  constexpr double kAgree =
      100;  // each side's own solve leaves noise of its tolerance in the exchange
  constexpr int kExtrapolate = 4;  // exchanges between two extrapolations
  const auto& block = op.system().block;
  const std::size_t n = b.size(), split = n_dcm_block < block.size()
                                              ? block[n_dcm_block].first_row * kPointStride
                                              : n;
  solve::CgResult total;
  std::vector<double> scaled(b.size());
  RowVector<double>& residual = work.residual;
  op.precondition(b, scaled);
  const double rhs = std::sqrt(op.dot(b, scaled));
  std::vector<double> before(x.begin(), x.end()), change(x.size(), 0.0);
  for (int exchange = 1; exchange <= kMaxExchanges; ++exchange) {
    for (const auto& [first, last] : {std::pair(std::size_t{0}, split), std::pair(split, n)}) {
      if (first == last) continue;
      const solve::CgResult alone =
          PartSolve(op, b, first, last).run(options.tolerance, options.max_iterations, x);
      total.iterations += alone.iterations;
      if (!alone.status.ok) {
        total.status = alone.status;
        return total;
      }
    }
    // Exchanges converge like a geometric series with one slow ratio (the drift of the whole
    // cluster): its limit is extrapolated now and then (Aitken).
    double same = 0, size = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double now = x[k] - before[k];
      same += now * change[k];
      size += change[k] * change[k];
      change[k] = now;
    }
    const double ratio = size > 0 ? same / size : 0;
    if (exchange % kExtrapolate == 0 && ratio > 0 && ratio < 1)
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += ratio / (1 - ratio) * change[k];
    std::ranges::copy(x, before.begin());

    // After the spheres' turn only the deformable side can disagree: its residual is the change of
    // the interface force since its own turn.
    residual.resize(b.size());
    op.apply(x, residual);
    for (std::size_t k = 0; k < b.size(); ++k) residual[k] = b[k] - residual[k];
    op.precondition(residual, scaled);
    total.residual = rhs > 0 ? std::sqrt(op.dot(residual, scaled)) / rhs : 0;
    if (total.residual <= kAgree * options.tolerance) return total;
  }
  total.status = Status::failed("the two models' interface forces did not agree");
  return total;
}

}  // namespace acinus::coupling
