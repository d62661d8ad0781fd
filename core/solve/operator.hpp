#pragma once
/// The matrix of a System as an operator, with its block-diagonal preconditioner.

#include <span>
#include <vector>

#include "core/solve/system.hpp"

namespace acinus::solve {

/// A System made ready for products. Links whose matrix is zero (they only pull) are left out; the
/// others work on a packed copy of the vector, because a point's components lie three cache lines
/// apart in the lane layout. Every block gathers its own rows in a fixed order: the same bits for
/// any number of threads.
class Operator {
 public:
  /// Reads the system; call again after its loads changed. Cost: linear in blocks and links.
  void prepare(const System& system);

  /// y = A x; returns x . y. Arrays [n_row][3][lane].
  double apply(std::span<const double> x, std::span<double> y) const;

  /// y = D^-1 x with the 3x3 diagonal blocks of A.
  void precondition(std::span<const double> x, std::span<double> y) const;

  /// One update of conjugate gradients: x += alpha p, r -= alpha q, z = D^-1 r; returns r . z.
  double descend(double alpha, std::span<const double> p, std::span<const double> q,
                 std::span<double> x, std::span<double> r, std::span<double> z) const;

  /// p = z + beta p.
  void redirect(std::span<const double> z, double beta, std::span<double> p) const;

  /// Adds the force of every link to the points it joins (pair and external links apart).
  void add_link_forces(std::span<double> pair_force, std::span<double> external_force) const;

  /// y = A_external x: friction with the medium and contacts with surroundings only.
  void apply_external(std::span<const double> x, std::span<double> y) const;

  /// Dot product, summed per block and then in block order.
  double dot(std::span<const double> a, std::span<const double> b) const;

  const System& system() const { return *system_; }

 private:
  /// One point's components together.
  struct alignas(32) Packed {
    double v[4];
  };
  /// A link with a matrix, its entries [first, last).
  struct Link {
    Sym3 matrix;
    std::uint32_t first, last;
    bool external;
  };
  struct Entry {
    std::uint32_t point, link;  ///< packed index row * kLanes + lane
    double weight;
  };
  void pack(std::span<const double> x) const;
  void compute_link_forces(bool external_only) const;
  void gather_links(std::size_t block, std::span<double> y) const;
  double sum_partials() const;
  bool parallel() const { return system_->n_row > kParallelRows; }
  /// Below this many point rows starting threads costs more than it saves.
  static constexpr std::size_t kParallelRows = 400;

  const System* system_ = nullptr;
  std::vector<Link> link_;
  std::vector<Entry> entry_;                ///< in link order
  std::vector<std::uint32_t> block_start_;  ///< [n_block + 1] CSR into block_entry_
  std::vector<Entry> block_entry_;          ///< sorted by block, link order within
  std::vector<double> inverse_;             ///< [n_row][6][lane]
  mutable std::vector<Packed> packed_;      ///< scratch of a product
  mutable std::vector<Packed> link_force_;  ///< scratch of a product
  mutable std::vector<double> partial_;     ///< scratch of a dot product
};

}  // namespace acinus::solve
