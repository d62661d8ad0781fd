#pragma once
/// What the contacts of two cells are to the rigid motions of both: their part of Z^T A Z.

#include <Eigen/Core>
#include <cstddef>

#include "core/lanes.hpp"

namespace acinus::solve {

/// A contact as the six motions of its two cells see it: J^T (k n n^T + g I) J, with
/// J = [I, -p x] on the first cell and -[I, -q x] on the second.
struct alignas(64) ContactModes {
  double u[kLanes] = {}, v[kLanes] = {};         ///< (n, p x n), (n, q x n)
  double arm[kLanes] = {};                       ///< (1, p, q)
  double k = 0, g = 0;                           ///< nN/um
  static constexpr int kFirst = 1, kSecond = 4;  ///< where p and q stand among the arms
};
/// Sums over contacts that join the same two cells, by rows of eight.
struct alignas(64) PairSums {
  double uu[6][kLanes], uv[6][kLanes], vv[6][kLanes];  ///< of k
  double arms[7][kLanes];                              ///< of g
};

/// The sums over n contacts, in their order.
void sum_contacts(std::size_t n, const ContactModes* contact, PairSums& sums);

/// What the contacts of two cells add to the diagonal block of each, and with a minus between them.
struct PairBlocks {
  Eigen::Matrix<double, 6, 6> aa, ab, bb;
};
PairBlocks blocks_of(const PairSums& sums);

}  // namespace acinus::solve
