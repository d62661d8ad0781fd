#pragma once
/// Solver of one implicit step on any graph of unknowns: conjugate gradients in double precision,
/// preconditioned with groups of unknowns (aggregates.hpp). One thread.

#include <cstddef>
#include <span>
#include <vector>

#include "substances/aggregates.hpp"
#include "substances/solve.hpp"

namespace acinus::substances {

/// Matrix own + sum of links on the diagonal, -link beside it, and right-hand side.
struct GraphSystem {
  std::vector<std::size_t> start{0};  ///< [n + 1] into to and link
  std::vector<int> to;
  std::vector<double> link;  ///< > 0
  std::vector<double> own;   ///< [n] >= 0
  std::vector<double> rhs;   ///< [n]
  std::size_t n() const { return own.size(); }
};

/// Link between two unknowns.
struct GraphLink {
  int a = 0, b = 0;
  double value = 0;
};

/// Sets start, to and link.
void set_links(std::size_t n, std::span<const GraphLink> links, GraphSystem& system);

class GraphSolver {
 public:
  /// Solves as Solver::solve, and to a thousandth of the residual of the guess.
  /// @param x  [n] initial guess; written
  SolveResult solve(const GraphSystem& system, double tolerance, std::span<double> x);

 private:
  Aggregates aggregates_;
  std::vector<double> r_, p_, q_, diagonal_;
  std::vector<float> rf_, z_;
};

}  // namespace acinus::substances
