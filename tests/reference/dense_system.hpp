#pragma once
/// The matrix of a System entry by entry, from the definition of its three operators. The index of
/// an unknown is its place in the [row][3][lane] arrays.

#include <Eigen/Dense>

#include "core/solve/system.hpp"

namespace acinus::reference {

inline Mat3 full_matrix(const Sym3& m) {
  Mat3 out;
  out << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return out;
}

/// Adds a 3x3 block between two points.
inline void add_block(Eigen::MatrixXd& to, Address a, Address b, const Mat3& m) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      to(a + static_cast<Address>(r) * kLanes, b + static_cast<Address>(c) * kLanes) += m(r, c);
}

inline Eigen::MatrixXd make_dense(const solve::System& s) {
  const auto n = static_cast<Eigen::Index>(s.n_dof());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  constexpr int kSymIndex[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int l = 0; l < kLanes; ++l) {
      Mat3 m;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          m(r, c) =
              s.diagonal[row * kSymStride + static_cast<std::size_t>(kSymIndex[r][c] * kLanes + l)];
      add_block(a, make_address(row, l), make_address(row, l), m);
    }
  for (const solve::Block& block : s.block)
    for (std::size_t p = 0; p < block.pattern->pair.size(); ++p)
      for (int l = 0; l < kLanes; ++l) {
        Mat3 m;
        for (int k = 0; k < 9; ++k)
          m(k / 3, k % 3) = s.upper[(block.first_pair + p) * kMatStride +
                                    static_cast<std::size_t>(k * kLanes + l)];
        const auto [i, j] = block.pattern->pair[p];
        const Address at_i = make_address(block.first_row + static_cast<std::size_t>(i), l);
        const Address at_j = make_address(block.first_row + static_cast<std::size_t>(j), l);
        add_block(a, at_i, at_j, m);
        add_block(a, at_j, at_i, m.transpose());
      }
  for (const solve::RankOne& family : s.rank_one)
    for (std::size_t b = 0; b * kLanes < family.coefficient.size(); ++b)
      for (int l = 0; l < kLanes; ++l) {
        Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
        for (int i = 0; i < s.block[b].pattern->n_point; ++i)
          for (Address c = 0; c < 3; ++c) {
            const Address at =
                make_address(s.block[b].first_row + static_cast<std::size_t>(i), l) + c * kLanes;
            g(at) = family.vector[at];
          }
        a += family.coefficient[b * kLanes + static_cast<std::size_t>(l)] * g * g.transpose();
      }
  for (std::size_t k = 0; k < s.links.size(); ++k) {
    const Mat3 m = s.friction_scale * full_matrix(s.links.friction[k]) +
                   s.stiffness_scale * full_matrix(s.links.stiffness[k]);
    for (std::uint32_t p = s.links.start[k]; p < s.links.start[k + 1]; ++p)
      for (std::uint32_t q = s.links.start[k]; q < s.links.start[k + 1]; ++q)
        add_block(a, s.links.address[p], s.links.address[q],
                  s.links.weight[p] * s.links.weight[q] * m);
  }
  return a;
}

}  // namespace acinus::reference
