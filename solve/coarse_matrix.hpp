#pragma once
/// Matrix of the coarse space, E = Z^T A Z, with six motions per cell in Z (three for a sphere):
/// rows of own cells, with the columns of all cells that touch them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solve/border_exchange.hpp"
#include "solve/operator.hpp"

namespace acinus::solve {

/// Cells and memory that a coarse matrix is made from.
struct CoarseInput {
  std::span<const double> position;      ///< [n_row][3][lane] um
  std::span<const std::uint8_t> active;  ///< [n_block * kLanes] 1 where the lane holds a cell
  RowVector<double>&mode, &product;      ///< scratch
};

class CoarseMatrix {
 public:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  /// Entry of two cells. Float halves the memory; E_ab and E_ba are exact transposes.
  using Entry = Eigen::Matrix<float, 6, 6>;

  /// Builds the rows of own cells. Collective.
  void assemble(const Operator& op, const CoarseInput& in);

  /// Number of own cells, which come first, in the order of their lanes.
  std::size_t n_own() const { return n_own_; }
  /// Number of cells with those of other processes that touch own ones.
  std::size_t n_cell() const { return lane_.size(); }
  LaneIndex lane_of(std::size_t cell) const { return lane_[cell]; }
  /// Arms (x - centre) / size of the points of own cells, [n_row][3][lane].
  const RowVector<float>& arm() const { return arm_; }
  RowVector<float>& arm() { return arm_; }

  /// Row of an own cell times a vector. Terms are added in the order of lanes, so the bits do not
  /// depend on owners.   @param x  [n_cell]
  Vec6 multiply(std::size_t cell, const std::vector<Vec6>& x) const;
  /// Inverse of the diagonal entry of an own cell times a vector.
  Vec6 invert_diagonal(std::size_t cell, const Vec6& x) const;

  /// Gets the values of cells of other processes. Collective.   @param x  [n_cell]
  void fetch(std::vector<Vec6>& x) const;

  std::size_t memory() const;  ///< of all that is not an array over rows, bytes

 private:
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  void number_cells(std::span<const std::uint8_t> active);
  void place_cells(std::span<const double> position);
  void join_cells(std::span<const std::uint8_t> active);
  void add_cells(const Operator& op, const CoarseInput& in);
  void add_links(const CoarseInput& in);
  void invert_diagonals();
  template <class T>
  void fetch_cells(std::vector<T>& x) const;
  bool owns(LaneIndex lane) const { return system_->ownership.owns(lane / kLanes); }
  std::size_t number_of(LaneIndex lane) const { return number_[lane] - 1; }
  /// Vector from the centre of a cell to a place, over the cell's size; zero for a single point.
  Vec3 arm_of(std::size_t cell, const Vec3& place) const;
  Entry& entry_of(std::size_t row, LaneIndex column);

  const System* system_ = nullptr;
  RowVector<std::uint32_t> number_;  ///< [n_block * kLanes] number of the cell + 1, 0: none
  std::vector<LaneIndex> lane_;      ///< [cell]
  std::size_t n_own_ = 0;
  RowVector<float> arm_;
  std::vector<Vec3> center_;               ///< [cell] um
  std::vector<double> size_;               ///< [cell] um
  std::vector<Entry> diagonal_, inverse_;  ///< [own cell]
  std::vector<std::size_t> start_;         ///< [n_own + 1] first entry of each row
  std::vector<std::uint32_t> column_;      ///< [entry] cells, ascending by lane
  std::vector<Entry> block_;               ///< [entry]
  ExchangePlan plan_;
  std::vector<std::uint32_t> send_;  ///< own cells; received are those from n_own on
};

}  // namespace acinus::solve
