#include "core/solve/cg.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::solve {
namespace {

/// Clears the entries outside the range.
void restrict_to(const System& s, BlockRange range, std::vector<double>& v) {
  const std::size_t n = s.block.size();
  const std::size_t first = range.first < n ? s.block[range.first].first_row : s.n_row;
  const std::size_t last = range.last < n ? s.block[range.last].first_row : s.n_row;
  std::fill_n(v.begin(), first * kPointStride, 0.0);
  std::fill(v.begin() + static_cast<std::ptrdiff_t>(last * kPointStride), v.end(), 0.0);
}

/// y = A x over all ranks; returns x . y.
double apply_distributed(const Operator& op, std::span<double> x, std::span<double> y) {
  op.system().halo.update(x);
  const double product = op.apply(x, y);
  op.system().halo.add_back(y);
  return product;
}

}  // namespace

CgResult solve_cg(const Operator& op, std::span<const double> b, std::span<double> x,
                  const CgOptions& options, CgWorkspace& work, BlockRange range) {
  const std::size_t n = b.size();
  const bool whole = range.first == 0 && range.last >= op.system().block.size();
  for (auto* v : {&work.residual, &work.direction, &work.preconditioned, &work.product})
    v->resize(n);
  auto& [r, p, z, q] = work;

  std::ranges::copy(b, r.begin());
  if (!whole) {
    // What the rest does to the range belongs to the right-hand side of this smaller system.
    std::ranges::copy(x, p.begin());
    restrict_to(op.system(), range, p);
    for (std::size_t k = 0; k < n; ++k) p[k] = x[k] - p[k];
    apply_distributed(op, p, q);
    for (std::size_t k = 0; k < n; ++k) r[k] -= q[k];
    restrict_to(op.system(), range, r);
  }
  op.precondition(r, z);
  const double rhs = std::sqrt(op.dot(r, z));
  CgResult result;
  if (!std::isfinite(rhs)) {
    result.status = Status::failed("the right-hand side is not finite");
    return result;
  }
  if (rhs == 0) {
    if (whole)
      std::ranges::fill(x, 0.0);
    else
      std::ranges::copy(p, x.begin());  // the rest as it was, zero within the range
    return result;
  }
  const double goal = options.tolerance * rhs;

  // Each pass starts from the true residual; a second pass only runs when rounding ate the first.
  for (int pass = 0; pass < 4; ++pass) {
    apply_distributed(op, x, q);
    for (std::size_t k = 0; k < n; ++k) r[k] = b[k] - q[k];
    if (!whole) restrict_to(op.system(), range, r);
    op.precondition(r, z);
    double rho = op.dot(r, z);
    result.residual = std::sqrt(rho) / rhs;
    if (result.residual <= options.tolerance) return result;
    std::ranges::copy(z, p.begin());
    while (result.iterations < options.max_iterations) {
      ++result.iterations;
      const double curvature = apply_distributed(op, p, q);  // p is zero outside the range
      if (!whole) restrict_to(op.system(), range, q);
      if (!(curvature > 0)) {
        result.status = Status::failed("the matrix is not positive definite");
        return result;
      }
      const double rho_next = op.descend(rho / curvature, p, q, x, r, z);
      if (!std::isfinite(rho_next)) {
        result.status = Status::failed("the linear solve became infinite");
        return result;
      }
      if (std::sqrt(rho_next) <= goal) break;
      const double beta = rho_next / rho;
      rho = rho_next;
      op.redirect(z, beta, p);
    }
    if (result.iterations >= options.max_iterations) {
      result.status = Status::failed("the linear solve did not converge");
      return result;
    }
  }
  return result;
}

}  // namespace acinus::solve
