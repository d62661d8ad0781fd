#pragma once
/// Exchange of ghost points, which contacts join across processes. Both processes of such a contact
/// know it, so both know the points that the other needs without asking.

#include <array>
#include <span>
#include <vector>

#include "solve/packed.hpp"
#include "solve/system.hpp"

namespace acinus::solve {

class PointExchange {
 public:
  /// Lists the points of the contacts that have a matrix, and of all contacts between surfaces,
  /// which may close during a step.
  void plan(const System& system);

  /// Gets packed points of other processes. Collective, as the next.
  template <class T>
  void fetch_packed(Packed<T>* x) const;

  /// Gets points of other processes in a vector [n_row][3][lane].
  void fetch(std::span<double> x) const;

  std::span<const Point> ghost_points() const { return receive_; }

  std::size_t n_sent() const {
    return send_.size();
  }  ///< points sent, counted once per receiving process

 private:
  Ranks ranks_ = Ranks::serial();
  ExchangePlan plan_;
  std::vector<Point> send_, receive_;  ///< own points, and ghost points
};

}  // namespace acinus::solve
