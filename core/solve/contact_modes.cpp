#include "core/solve/contact_modes.hpp"

namespace acinus::solve {
namespace {

using Block6 = Eigen::Matrix<double, 6, 6>;

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Sum of J_p^T (k n n^T + g I) J_q.
/// @param first, second  where p and q stand among the arms
Block6 pair_block(const double (&stiffness)[6][kLanes], const double (&arms)[7][kLanes], int first,
                  int second) {
  Block6 m;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) m(i, j) = stiffness[i][j];
  const auto sum_of = [&](int at) { return Vec3(arms[0][at], arms[0][at + 1], arms[0][at + 2]); };
  Mat3 pq;  // p q^T
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) pq(i, j) = arms[first + i][second + j];
  m.topLeftCorner<3, 3>().diagonal().array() += arms[0][0];
  m.bottomLeftCorner<3, 3>() += cross_matrix(sum_of(first));
  m.topRightCorner<3, 3>() -= cross_matrix(sum_of(second));
  m.bottomRightCorner<3, 3>() -= pq.transpose();
  m.bottomRightCorner<3, 3>().diagonal().array() += pq.trace();
  return m;
}

}  // namespace

ACINUS_KERNEL void sum_contacts(std::size_t n, const ContactModes* contact, PairSums& sums) {
  Lane uu[6] = {}, uv[6] = {}, vv[6] = {}, arms[7] = {};
  for (std::size_t c = 0; c < n; ++c) {
    const ContactModes& m = contact[c];
    const Lane u = load(m.u), v = load(m.v), arm = load(m.arm);
    for (int i = 0; i < 6; ++i) {
      const Lane ku = lane_of(m.k * m.u[i]);
      uu[i] += ku * u;
      uv[i] += ku * v;
      vv[i] += lane_of(m.k * m.v[i]) * v;
    }
    for (int i = 0; i < 7; ++i) arms[i] += lane_of(m.g * m.arm[i]) * arm;
  }
  for (int i = 0; i < 6; ++i) {
    store(sums.uu[i], uu[i]);
    store(sums.uv[i], uv[i]);
    store(sums.vv[i], vv[i]);
  }
  for (int i = 0; i < 7; ++i) store(sums.arms[i], arms[i]);
}

PairBlocks blocks_of(const PairSums& s) {
  return {pair_block(s.uu, s.arms, ContactModes::kFirst, ContactModes::kFirst),
          pair_block(s.uv, s.arms, ContactModes::kFirst, ContactModes::kSecond),
          pair_block(s.vv, s.arms, ContactModes::kSecond, ContactModes::kSecond)};
}

}  // namespace acinus::solve
