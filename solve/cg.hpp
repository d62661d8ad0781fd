#pragma once
/// Preconditioned conjugate gradients, iterated in float and checked in double. The preconditioner
/// is block-diagonal, with a coarse space if wanted.

#include <array>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "solve/coarse.hpp"
#include "solve/operator.hpp"

namespace acinus::solve {

/// Number type of the iterations.
enum class Precision {
  kMixed,  ///< float, in passes that each start from the true residual in double
  kDouble
};

struct CgOptions {
  double tolerance = 3e-3;  ///< on sqrt(r^T M^-1 r), relative to sqrt(b^T M^-1 b)
  int max_iterations = 2000;
  Precision precision = Precision::kMixed;
};

struct CgResult {
  Status status;
  int iterations = 0;
  int float_passes = 0, double_passes = 0;
  double residual = 0;  ///< relative, in the norm above, from the true residual b - A x in double
};

/// Scratch, sized on first use.
struct CgWorkspace {
  RowVector<double> residual;  ///< b - A x of the solution returned
  double load = 0;            ///< norm that the tolerance refers to; solve_cg sets sqrt(b^T M^-1 b)
  RowVector<double> product;  ///< scratch; free for other use between solves
  std::array<RowVector<double>, 5> vector;  ///< of passes in double

  template <class F>
  void for_each_row_array(const F& f) {
    f(residual);
    f(product);
    for (RowVector<double>& v : vector) f(v);
  }
};

/// Linear system A x = b with its preconditioner.
struct CgProblem {
  Operator& op;               ///< A; its contacts are merged when passes in float turn out long
  std::span<const double> b;  ///< [n_row][3][lane] right-hand side
  /// Second part of the preconditioner, prepared for op; null: diagonal blocks alone. The tolerance
  /// is in the norm of the diagonal blocks either way.
  const CoarseSpace* coarse = nullptr;
  int expected_iterations = 0;  ///< from a similar solve; 0: unknown. Changes rounding only
};

/// Solves A x = b from the start value in x (warm start). The tolerance is relative to the
/// right-hand side, not to the first residual, so that a good start saves iterations. Passes of
/// iterations solve for a correction of x; each starts from the true residual in double, which also
/// decides convergence. A pass in float that breaks down or gains nothing is followed by one in
/// double; when that gains nothing either, rounding limits the accuracy: the result is ok if the
/// residual is below 1e-3, and states it. Fails when the process is asked to stop.
CgResult solve_cg(const CgProblem& problem, std::span<double> x, const CgOptions& options,
                  CgWorkspace& work);

/// Solves from a known residual, with a known norm that the tolerance is relative to: a system that
/// changed a little since solve_cg, with the preconditioner that op has now and the coarse space of
/// before, or one whose first residual is known.
/// @pre work.residual is b - A x, and work.load is not 0
CgResult continue_cg(const CgProblem& problem, std::span<double> x, const CgOptions& options,
                     CgWorkspace& work);

}  // namespace acinus::solve
