#pragma once
/// The matrix of a System as an operator, with its block-diagonal preconditioner.

#include <span>
#include <vector>

#include "core/solve/system.hpp"

namespace acinus::solve {

/// A System made ready for products: link matrices summed, link entries sorted by block so that every
/// block gathers its own rows in a fixed order (the same bits for any number of threads).
class Operator {
 public:
  /// Reads the system; call again after its loads changed. Cost: linear in blocks and links.
  void prepare(const System& system);

  /// y = A x. Arrays [n_row][3][lane].
  void apply(std::span<const double> x, std::span<double> y) const;

  /// y = D^-1 x with the 3x3 diagonal blocks of A.
  void precondition(std::span<const double> x, std::span<double> y) const;

  /// Adds the force of every link to the points it joins (pair and external links apart).
  void add_link_forces(std::span<double> pair_force, std::span<double> external_force) const;

  /// y = A_external x: friction with the medium and contacts with surroundings only.
  void apply_external(std::span<const double> x, std::span<double> y) const;

  /// Dot product, summed per block and then in block order.
  double dot(std::span<const double> a, std::span<const double> b) const;

  const System& system() const { return *system_; }

 private:
  void compute_link_forces(std::span<const double> x, bool external_only) const;

  const System* system_ = nullptr;
  std::vector<Sym3> link_matrix_;
  std::vector<std::uint32_t> entry_start_;   ///< [n_block + 1] CSR into entry_
  std::vector<std::uint32_t> entry_;         ///< indices into links.address, ascending within a block
  std::vector<std::uint32_t> entry_link_;    ///< link of every entry of links.address
  std::vector<double> inverse_;              ///< [n_row][6][lane]
  mutable std::vector<Vec3> link_force_;     ///< scratch of a product
  mutable std::vector<double> partial_;      ///< scratch of a dot product
};

}  // namespace acinus::solve
