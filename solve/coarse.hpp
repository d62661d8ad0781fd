#pragma once
/// Coarse space of rigid cells: a second part of the preconditioner, z = M^-1 r + Z E^-1 Z^T r,
/// with six motions per cell in Z (three for a sphere) and E = Z^T A Z.
///
/// Friction and contact between cells decide how fast the iteration converges in packed tissue; the
/// diagonal blocks do not couple neighbours. E is factored incompletely (block Cholesky without
/// fill), so it costs about as much as two products, and applying it a fraction of one. Every
/// process has the factor of all cells: it computes the rows of its own and gets the others.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solve/operator.hpp"

namespace acinus::solve {

class CoarseSpace {
 public:
  /// Builds and factors E for the operator's present system.
  /// @param position  [n_row][3][lane] um
  /// @param active    [n_block * kLanes] 1 where the lane holds a cell
  void prepare(const Operator& op, std::span<const double> position,
               std::span<const std::uint8_t> active);

  /// Adds the coarse correction: z += Z E^-1 Z^T r; returns r . Z E^-1 Z^T r.
  double add(std::span<const float> r, std::span<float> z) const;
  double add(std::span<const double> r, std::span<double> z) const;

  /// Memory of all that is not an array over rows, bytes.
  std::size_t memory() const {
    return memory_of(cell_) + memory_of(block_of_cell_) + memory_of(center_) + memory_of(size_) +
           memory_of(start_) + memory_of(column_) + memory_of(block_) + memory_of(small_);
  }

  /// Calls f(array) for all arrays over rows.
  template <class F>
  void for_each_row_array(const F& f) {
    f(arm_);
  }

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  /// Rows of E that one of n_part parts adds to.
  struct RowShare {
    std::size_t part, n_part;
    bool owns(std::size_t cell) const { return cell % n_part == part; }
  };
  template <class T>
  double add_of(std::span<const T> r, std::span<T> z) const;
  void place_cells(std::span<const double> position, std::span<const std::uint8_t> active);
  int cell_of(Point p) const;
  bool owns(int cell) const { return system_->ownership.owns(block_of_cell_[cell]); }
  void make_pattern();
  void gather_rows();
  template <class T>
  void gather_cells(std::vector<T>& v) const;
  void add_cells(const Operator& op);
  void add_links(std::span<const double> position);
  /// Adds the entries of one contact to the rows of the cells that a part owns.
  /// @param ends  places of the two sides, um; that of b is unused if b < 0 (boundary)
  template <class L, class Ends>
  void add_link(const RowShare& share, int a, int b, const Ends& ends, const L& link);
  /// Vector from the centre of a cell to a place, over the cell's size; zero for a single point.
  Vec3 arm_of(std::size_t cell, const Vec3& place) const;
  /// Index in block_ of the entry of two cells.
  std::size_t entry_of(int a, int b) const;
  void factor();
  void solve(std::vector<Vec6>& v) const;

  const System* system_ = nullptr;
  std::vector<int> cell_;  ///< [n_block * kLanes] number of the cell, -1: none
  std::vector<std::size_t> block_of_cell_;
  RowVector<float> arm_;      ///< [n_row][3][lane] (x - centre) / size of the cell
  std::vector<Vec3> center_;  ///< [cell] um
  std::vector<double>
      size_;  ///< CSR pattern of the lower triangle; columns ascend, the diagonal is last
  std::vector<int> start_, column_;  ///< lower triangle by rows, columns ascending, diagonal last
  std::vector<Mat6> block_;          ///< E, then its factor
  mutable std::vector<Vec6> small_;  ///< scratch of add
};

}  // namespace acinus::solve
