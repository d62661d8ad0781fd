#pragma once
/// Coarse space of rigid cells: a second part of the preconditioner, z = M^-1 r + Z P Z^T r, with
/// six motions per cell in Z (three for a sphere) and P close to the inverse of E = Z^T A Z.
///
/// Friction and contact between cells decide how fast the iteration converges in packed tissue; the
/// diagonal blocks do not couple neighbours. P is a Chebyshev polynomial of E, scaled by its
/// diagonal entries (decision 63): products alone, in which each process, and each thread, has the
/// rows of its own cells.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solve/coarse_matrix.hpp"

namespace acinus::solve {

class CoarseSpace {
 public:
  /// Builds E for the operator's present system.
  void prepare(const Operator& op, const CoarseInput& in);

  /// Adds the coarse correction: z += Z P Z^T r; returns r . Z P Z^T r. Collective.
  double add(std::span<const float> r, std::span<float> z) const;
  double add(std::span<const double> r, std::span<double> z) const;

  /// Memory of all that is not an array over rows, bytes.
  std::size_t memory() const;

  /// Calls f(array) for all arrays over rows.
  template <class F>
  void for_each_row_array(const F& f) {
    f(matrix_.arm());
  }

  /// Number of products with E is one less.
  static constexpr int kDegree = 3;
  /// Ratio of the ends of the interval of eigenvalues for which the polynomial is the best.
  static constexpr double kSpread = 10;
  /// Upper end: no eigenvalue of D^-1 E is larger, D being the diagonal entries, since a contact is
  /// between two cells.
  static constexpr double kLargest = 2;

 private:
  using Vec6 = CoarseMatrix::Vec6;
  /// Own cells of one block: [first, last).
  struct CellRun {
    std::size_t block, first, last;
  };
  template <class T>
  double add_of(std::span<const T> r, std::span<T> z) const;
  void apply_polynomial() const;

  const System* system_ = nullptr;
  CoarseMatrix matrix_;
  std::vector<CellRun> run_;
  /// Scratch of add: load and result of own cells, residual, and directions of all.
  mutable std::vector<Vec6> load_, sum_, residual_, direction_, next_;
};

}  // namespace acinus::solve
