/// Replacement of core/parallel/partition.cpp for simulated MPI, with which Zoltan cannot be
/// linked.

#include "core/parallel/partition.hpp"

#include <algorithm>
#include <numeric>

#include "core/box.hpp"

namespace acinus {
namespace {

/// Recursive bisection of points by cost across the longest side of their box, down to one part per
/// rank.
class Bisection {
 public:
  Bisection(std::span<const Vec3> place, std::span<const double> cost)
      : place_(place), cost_(cost), owner_(place.size(), 0) {}

  std::vector<int> run(int n_rank) {
    std::vector<int> all(place_.size());
    std::iota(all.begin(), all.end(), 0);
    divide(all, 0, n_rank);
    return std::move(owner_);
  }

 private:
  /// Divides points among the ranks first to last - 1.
  void divide(std::span<int> some, int first, int last) {
    if (last - first == 1) {
      for (const int k : some) owner_[k] = first;
      return;
    }
    Box box;
    double whole = 0;
    for (const int k : some) {
      box.include(place_[k]);
      whole += cost_[k];
    }
    int axis = 0;
    if (!some.empty()) (box.high - box.low).maxCoeff(&axis);
    std::ranges::sort(some, {}, [&](int k) { return std::pair(place_[k][axis], k); });
    const int middle = first + (last - first) / 2;
    const double share = whole * (middle - first) / (last - first);
    double before = 0;
    std::size_t n = 0;
    while (n < some.size() && before + 0.5 * cost_[some[n]] < share) before += cost_[some[n++]];
    divide(some.first(n), first, middle);
    divide(some.subspan(n), middle, last);
  }

  std::span<const Vec3> place_;
  std::span<const double> cost_;
  std::vector<int> owner_;
};

}  // namespace

std::vector<int> partition(const Ranks& ranks, std::span<const Vec3> place,
                           std::span<const double> cost) {
  return Bisection(place, cost).run(ranks.size());
}

}  // namespace acinus
