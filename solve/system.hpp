#pragma once
/// Linear system of one step, (Gamma/h + K) dx = F, as loads that the models add to.
///
/// Unknowns: blocks of eight lanes; a DCM group has one row per mesh node, eight spheres share a
/// block with a single row. The matrix is never assembled: it is kept as its small elements
/// (springs, hinges, faces, one vector per cell, contacts), each blind to translation by its form,
/// whatever the rounding of its numbers, and positive semi-definite (a spring as long as its two
/// coefficients keep a + c >= 0, which rounding does not change). That is why elements may be
/// floats (decision 10).

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/numbers/lanes.hpp"
#include "core/parallel/row_vector.hpp"
#include "core/parallel/threads.hpp"
#include "solve/blocks.hpp"
#include "solve/links.hpp"
#include "solve/ownership.hpp"

namespace acinus::solve {

/// Fills spring_of and first_spring_of.
void index_springs(BlockPattern& pattern);

/// Index of the spring between two points. @pre index_springs, and the spring exists
inline std::size_t find_spring(const BlockPattern& p, int i, int j) {
  std::size_t k = p.first_spring_of[i];
  while (p.spring_of[k][0] != j) {
    ++k;
    ACINUS_ASSERT(k < p.first_spring_of[i + 1]);
  }
  return p.spring_of[k][1];
}

/// Floats of one element, all eight lanes.
/// a, c: matrix a d d^T + c I on x_j - x_i, with the difference d = s_j - s_i of the shape
inline constexpr int kSpringStride = 2 * kLanes;
/// a, b, c, e: g = a n1 on wing 0, b n2 on wing 1, c n1 + e n2 on spring point 0, and on spring
/// point 1 minus their sum: matrix g g^T. Normals of the two faces, from d of the spring: n1 = d x
/// (s_wing0 - s_j), n2 = (s_wing1 - s_j) x d
inline constexpr int kHingeStride = 4 * kLanes;
inline constexpr int kEdgeStride = 6 * kLanes;  ///< xx xy xz yy yz zz: a spring's matrix in full
inline constexpr int kFaceStride = 6 * kLanes;  ///< g1 g2, g3 = -(g1 + g2): matrix g g^T
/// g on the second end, minus that on the first; on the rotations; in two directions across the
/// beam: matrix g g^T + h h^T
inline constexpr int kBeamStride = 12 * kLanes;

/// Index of a lane over all blocks: block * kLanes + lane.
using LaneIndex = std::uint32_t;

/// Rank-one family: one vector per cell with a non-negative coefficient; adds c g g^T. Covers
/// blocks [0, n_block).
struct RankOne {
  RowVector<float> vector;          ///< [rows of the covered blocks][3][lane]
  std::vector<double> coefficient;  ///< [n_block][lane]
};

/// Loads of one step. The caller clears; models add. Rows of blocks that are not own hold nothing.
struct System {
  Blocks block;
  std::size_t n_row = 0;       ///< point rows over all blocks
  Ownership ownership;         ///< to be set before set_blocks
  std::vector<BlockRun> own;   ///< own blocks
  double friction_scale = 1;   ///< 1/h, 1/s: factor of friction in the matrix
  double stiffness_scale = 1;  ///< 1: linearly implicit; 0: friction only (explicit Euler)

  RowVector<double> force;           ///< [n_row][3][lane] nN, forces inside and between cells
  RowVector<double> external_force;  ///< [n_row][3][lane] nN, migration and prescribed loads
  RowVector<double> medium;          ///< [n_row][lane] nN s/um, friction with the medium at rest
  RowVector<float> shape;            ///< [n_shape_row][3][lane] um, places of points of springs
  RowVector<float> spring;           ///< [n_spring][2][lane] nN/um^3 and nN/um
  RowVector<float> hinge;            ///< [n_hinge][4][lane] times a normal: sqrt(nN/um)
  RowVector<float> face;             ///< [n_face][6][lane] sqrt(nN/um)
  RowVector<float> beam;             ///< [n_beam][12][lane] sqrt(nN/um)
  std::vector<RankOne> rank_one;
  Links links;             ///< contacts of surfaces
  PointLinks point_links;  ///< contacts of spheres; friction from node to node

  std::size_t n_dof() const { return n_row * kPointStride; }
  std::size_t block_of(Point p) const { return block.block_of_row(p / kLanes); }
  /// Lane of the point's cell.
  LaneIndex lane_of(Point p) const {
    return static_cast<LaneIndex>(block_of(p) * kLanes + p % kLanes);
  }
  bool owns(Point p) const { return ownership.is_whole() || ownership.owns(block_of(p)); }
  std::size_t n_own() const {
    std::size_t n = 0;
    for (const auto& [first, last] : own) n += last - first;
    return n;
  }
  /// First row of a block; for b = number of blocks, the number of rows.
  std::size_t row_of(std::size_t b) const { return block.row_of(b); }
};

/// Calls f(k, b) for every own block b, the k-th of them. The calls may be at the same time.
template <class F>
void for_each_own_block(const System& s, const F& f) {
  for_each_index(s.n_own(), worth_threads(s.n_row), [&](std::size_t k) {
    std::size_t run = 0, left = k;
    for (; left >= s.own[run].second - s.own[run].first; ++run)
      left -= s.own[run].second - s.own[run].first;
    f(k, s.own[run].first + left);
  });
}

/// Calls f(k) for the indices k of own blocks in vectors [n_row][3][lane].
template <class F>
void for_each_own_number(const System& s, const F& f) {
  const auto begin = [&](std::size_t b) { return s.row_of(b) * kPointStride; };
  if (s.own.size() == 1) {
    const std::size_t first = begin(s.own[0].first);
    for_each_number(begin(s.own[0].second) - first, [&](std::size_t k) { f(first + k); });
    return;
  }
  for_each_index(s.own.size(), worth_threads(s.n_row), [&](std::size_t run) {
    for (std::size_t k = begin(s.own[run].first); k < begin(s.own[run].second); ++k) f(k);
  });
}

/// Calls f(k) for the indices k of own blocks in an array.
/// @param offset  offset(b): index of the first number of a block
/// @param n       length of the array, which may end before the last block
template <class Offset, class F>
void for_each_own_number(const System& s, const Offset& offset, std::size_t n, const F& f) {
  for (const auto& [first, last] : s.own) {
    const auto begin_of = [&](std::size_t b) {
      return std::min(n, b < s.block.size() ? offset(s.block[b]) : n);
    };
    const std::size_t begin = begin_of(first), end = begin_of(last);
    for_each_number(end - begin, [&](std::size_t k) { f(begin + k); });
  }
}

/// Clears the rows of own blocks in an array with `stride` numbers a row.
template <class T>
void clear_own_rows(const System& s, std::size_t stride, RowVector<T>& v) {
  for_each_own_number(
      s, [&](const Block& b) { return b.first_row * stride; }, v.size(),
      [&](std::size_t k) { v[k] = 0; });
}

/// Calls f(array) for all arrays over rows and elements, in which rows of other processes have no
/// memory.
template <class S, class F>
void for_each_row_array(S& system, const F& f) {
  for (auto* v : {&system.force, &system.external_force, &system.medium}) f(*v);
  for (auto* v : {&system.shape, &system.spring, &system.hinge, &system.face, &system.beam}) f(*v);
  for (auto& family : system.rank_one) f(family.vector);
}

/// Sizes all arrays for the given blocks and clears them. @pre ownership
void set_blocks(System& system, Blocks blocks);

/// Gathers the rows of all processes: every row of x becomes that of its owner.
/// @param x  [n_row][3][lane]
void gather_rows(const System& system, std::span<double> x);

/// Gathers the rows of all processes a part at a time: calls put(k, rows) for whole blocks in their
/// order, of which rows[0] has index k in vectors [n_row][3][lane]. With one process the rows are
/// all of x. Collective.
/// @param x     [n_row][3][lane], of which only own rows are read
/// @param most  rows at a time; by default 8 MB of them
void stream_rows(const System& system, std::span<const double> x,
                 const std::function<void(std::size_t, std::span<const double>)>& put,
                 std::size_t most = 40000);

/// Zeroes every load that models add to; keeps capacity and scales. Shapes, hinges, faces, beams
/// and point links are written, not added to, by the one term each belongs to.
void clear_loads(System& system);

/// Adds a d d^T + c I to a spring.
ACINUS_INLINE void add_spring(float* element, Lane a, Lane c) {
  store(element, load(element) + a);
  store(element + kLanes, load(element + kLanes) + c);
}

}  // namespace acinus::solve
