#pragma once
/// Adhesion energy between two cell types.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace acinus::contact {

/// Adhesion energy of a pair, nN/um: that given for the two types, else the geometric mean of
/// theirs.
/// @param type_b  number of b's type
template <class ParamsA, class ParamsB>
double pair_adhesion(const ParamsA& a, const ParamsB& b, std::size_t type_b) {
  return a.adhesion_with.empty() ? std::sqrt(a.adhesion * b.adhesion) : a.adhesion_with[type_b];
}

/// Factor on the adhesion energy of a pair: the geometric mean of those of its sides.
/// @param of_a, of_b  factors on the adhesion energy of cells; empty: all 1
inline double adhesion_factor(std::span<const double> of_a, std::size_t a,
                              std::span<const double> of_b, std::size_t b) {
  return of_a.empty() ? 1 : std::sqrt(of_a[a] * of_b[b]);
}

/// Largest adhesion energy of any pair, nN/um.
template <class AllParams>
double largest_adhesion(const AllParams& params) {
  double largest = 0;
  for (const auto& p : params) {
    largest = std::max(largest, p.adhesion);
    for (const double w : p.adhesion_with) largest = std::max(largest, w);
  }
  return largest;
}

}  // namespace acinus::contact
