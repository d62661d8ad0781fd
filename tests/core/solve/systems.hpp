#pragma once
/// A random positive definite system with everything in it.

#include <algorithm>
#include <vector>

#include "core/solve/operator.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::solve {

inline const BlockPattern kFive{5, {{0, 1}, {1, 2}, {0, 4}, {3, 4}, {1, 3}}};
inline const BlockPattern kSeven{7, {{0, 6}, {2, 5}, {1, 4}, {0, 3}, {5, 6}, {2, 3}}};
inline const BlockPattern kSingle{1, {}};

inline Sym3 random_sym(UniformStream& random) {
  return Sym3::outer(random.uniform(0.5, 1), random.unit_vector()) +
         Sym3::outer(random.uniform(0, 0.5), random.unit_vector());
}

/// Adds s v v^T for a vector over two points of one lane.
inline void add_pair(System& s, const Block& block, std::size_t pair, int lane, const Vec3& a,
                     const Vec3& b) {
  const auto [i, j] = block.pattern->pair[pair];
  constexpr int kRow[6] = {0, 0, 0, 1, 1, 2}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    const auto at = static_cast<std::size_t>(k * kLanes + lane);
    s.diagonal[(block.first_row + static_cast<std::size_t>(i)) * kSymStride + at] +=
        a[kRow[k]] * a[kColumn[k]];
    s.diagonal[(block.first_row + static_cast<std::size_t>(j)) * kSymStride + at] +=
        b[kRow[k]] * b[kColumn[k]];
  }
  for (int k = 0; k < 9; ++k)
    s.upper[(block.first_pair + pair) * kMatStride + static_cast<std::size_t>(k * kLanes + lane)] +=
        a[k / 3] * b[k % 3];
}

/// Two groups of deformable cells and two rows of spheres; two rank-one families, the second of
/// which covers the first group only; pair links of 2 to 6 points, links with surroundings, and one
/// link within a single cell.
/// @param copies  more groups than that: enough rows for threads to start
inline System make_system(std::uint64_t seed, int copies = 1) {
  auto random = reference::stream(seed);
  System s;
  s.friction_scale = 0.7;
  s.stiffness_scale = 1.3;
  std::vector<Block> blocks{{&kFive, 0, 0}};
  for (int k = 0; k < copies; ++k) blocks.push_back({&kSeven, 0, 0});
  for (int k = 0; k < 2; ++k) blocks.push_back({&kSingle, 0, 0});
  set_blocks(s, blocks);
  for (double& m : s.medium) m = random.uniform(0.05, 0.2);
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int k : {0, 3, 5})
      for (int l = 0; l < kLanes; ++l)
        s.diagonal[row * kSymStride + static_cast<std::size_t>(k * kLanes + l)] =
            s.friction_scale * s.medium[row * kLanes + static_cast<std::size_t>(l)];
  for (const Block& block : s.block)
    for (std::size_t p = 0; p < block.pattern->pair.size(); ++p)
      for (int l = 0; l < kLanes; ++l)
        for (int k = 0; k < 2; ++k) {
          const Vec3 a = reference::random_vector(random, 1);
          add_pair(s, block, p, l, a, reference::random_vector(random, 1));
        }
  for (std::size_t n_block : {s.block.size(), std::size_t{1}}) {
    const std::size_t rows = n_block > 1 ? s.n_row : 5;
    RankOne family{std::vector<double>(rows * kPointStride), std::vector<double>(n_block * kLanes)};
    for (double& v : family.vector) v = random.uniform(-1, 1);
    for (double& v : family.coefficient) v = random.uniform(0, 0.5);
    s.rank_one.push_back(family);
  }
  std::vector<Address> used;  // a stencil never names a point twice
  const auto anywhere = [&] {
    for (;;) {
      const Address a = make_address(random.index(s.n_row), static_cast<int>(random.index(kLanes)));
      if (std::ranges::count(used, a) == 0) return used.emplace_back(a);
    }
  };
  for (int k = 0; k < 60 * copies; ++k) {
    used.clear();
    const bool external = k % 5 == 0;
    const int half = 1 + static_cast<int>(random.index(3));
    for (int p = 0; p < half; ++p) s.links.add_point(anywhere(), 1.0 / half);
    if (!external)
      for (int p = 0; p < half; ++p) s.links.add_point(anywhere(), -1.0 / half);
    const bool only_pulls = k % 7 == 3;  // no matrix: cohesive softening beyond the friction range
    const Sym3 stiffness = only_pulls ? Sym3{} : random_sym(random);
    const Sym3 friction = only_pulls ? Sym3{} : random_sym(random);
    s.links.close(reference::random_vector(random, 1), stiffness, friction, external, Vec3::UnitX(),
                  0);
  }
  return s;
}

inline std::vector<double> random_vector_of(const System& s, std::uint64_t seed) {
  auto random = reference::stream(seed);
  std::vector<double> v(s.n_dof());
  for (double& x : v) x = random.uniform(-1, 1);
  return v;
}

inline Eigen::Map<const Eigen::VectorXd> as_eigen(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

}  // namespace acinus::solve
