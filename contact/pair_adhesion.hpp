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

/// Adhesion energy that counts as none, nN/um: scenes take no smaller one, and the laws of contact
/// divide by powers of it.
inline constexpr double kLeastAdhesion = 1e-15;

/// Adhesion energy of a pair whose sides respond to signals, nN/um: times the geometric mean of the
/// factors of both.
/// @param of_a, of_b  factors on the adhesion energy of cells; empty: all 1
inline double scale_adhesion(double adhesion, std::span<const double> of_a, std::size_t a,
                             std::span<const double> of_b, std::size_t b) {
  if (of_a.empty()) return adhesion;
  const double scaled = adhesion * std::sqrt(of_a[a] * of_b[b]);
  return scaled < kLeastAdhesion ? 0 : scaled;
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
