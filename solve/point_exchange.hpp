#pragma once
/// Points that contacts join across processes. Both ends of such a contact know it, so both know
/// which points the other needs, and nobody has to ask.

#include <array>
#include <span>
#include <vector>

#include "solve/packed.hpp"
#include "solve/system.hpp"

namespace acinus::solve {

class PointExchange {
 public:
  /// Finds the points of the contacts that have a matrix, and of all between surfaces, which a step
  /// may close.
  void plan(const System& system);

  /// Gets packed points of other processes. To be called by all, as the next.
  template <class T>
  void fetch_packed(Packed<T>* x) const;

  /// The same of a vector [n_row][3][lane].
  void fetch(std::span<double> x) const;

  std::size_t n_sent() const { return send_.size(); }  ///< points, each to one process

 private:
  Ranks ranks_ = Ranks::serial();
  ExchangePlan plan_;
  std::vector<Point> send_, receive_;  ///< own points, and those of others
};

}  // namespace acinus::solve
