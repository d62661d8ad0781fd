#pragma once
/// Kernels of contacts on packed points: products, forces and diagonal blocks.

#include <array>
#include <span>
#include <vector>

#include "core/parallel/make_room.hpp"
#include "core/parallel/row_vector.hpp"
#include "solve/links.hpp"
#include "solve/packed.hpp"

namespace acinus::solve {

/// Contact, or row of pairs, of one thread, with the sides that the thread owns.
struct Share {
  std::uint32_t link : 30;
  std::uint32_t a : 1, b : 1;
};

/// Shares of one thread, as lists that follow each other.
using ShareLists = std::vector<LargeVector<Share>>;

/// Contacts of one thread.
template <class L>
struct LinkSet {
  std::span<const L> link;
  const ShareLists& share;
};

/// Factors of contact coefficients in the matrix.
struct LinkScales {
  double stiffness = 1, friction = 1;
};

/// Product y += (stiffness n n^T + friction I) r, distributed over the points of each contact.
void multiply_links(const LinkSet<Link>& set, LinkScales scales, const Packed<double>* x,
                    Packed<double>* y);
void multiply_links(const LinkSet<Link>& set, LinkScales scales, const Packed<float>* x,
                    Packed<float>* y);
void multiply_links(const LinkSet<PointLink>& set, LinkScales scales, const Packed<double>* x,
                    Packed<double>* y);
void multiply_links(const LinkSet<PointLink>& set, LinkScales scales, const Packed<float>* x,
                    Packed<float>* y);

/// Adds to y the forces of contacts between cells, or of contacts with boundary.
void add_forces(const LinkSet<Link>& set, const LinkForce& force, bool external, Packed<double>* y);

/// True if a contact contributes to the matrix.
template <class L>
bool has_matrix(const L& l, double stiffness_scale) {
  return stiffness_scale * static_cast<double>(l.stiffness) > 0 || l.friction > 0;
}

/// Symmetric 3x3 block: xx, xy, xz, yy, yz, zz and two zeros.
using SymBlock = std::array<float, 8>;

/// Matrix of a contact: stiffness n n^T + friction I.
template <class L>
ACINUS_INLINE SymBlock matrix_of(const L& l, LinkScales scales) {
  const float k = static_cast<float>(scales.stiffness) * l.stiffness,
              f = static_cast<float>(scales.friction) * l.friction;
  const auto& n = l.normal;
  return {k * n[0] * n[0] + f,
          k * n[0] * n[1],
          k * n[0] * n[2],
          k * n[1] * n[1] + f,
          k * n[1] * n[2],
          k * n[2] * n[2] + f,
          0,
          0};
}

/// Blocks between pairs of points, sorted by first point: the force on b is block (x_a - x_b), that
/// on a the opposite.
struct PointPairs {
  /// Pairs of one point.
  struct Row {
    Point a = 0;
    std::uint32_t first = 0, last = 0;  ///< range in b and block
  };
  std::vector<Row> row;
  std::vector<Point> b;
  std::vector<SymBlock> block;

  std::size_t memory() const {
    return memory_of(row) + memory_of(b) + memory_of(block);
  }  ///< bytes
  void clear() {
    row.clear();
    b.clear();
    block.clear();
  }
  void make_room(std::size_t n_pair, std::size_t n_row) {
    acinus::make_room(row, n_row);
    acinus::make_room(b, n_pair);
    acinus::make_room(block, n_pair);
  }
  void append(const PointPairs& more) {
    const auto offset = static_cast<std::uint32_t>(b.size());
    make_room(more.b.size(), more.row.size());
    for (const Row& r : more.row) row.push_back({r.a, r.first + offset, r.last + offset});
    b.insert(b.end(), more.b.begin(), more.b.end());
    block.insert(block.end(), more.block.begin(), more.block.end());
  }
};

/// Adds the forces of the pairs, for the rows of a share and on the points it owns: all second
/// points of a row belong to one cell.
void multiply_pairs(const PointPairs& pairs, const ShareLists& share, const Packed<float>* x,
                    Packed<float>* y);

void add_diagonal(const LinkSet<Link>& set, LinkScales scales, SymBlock* diagonal);
void add_diagonal(const LinkSet<PointLink>& set, LinkScales scales, SymBlock* diagonal);

/// Conversion between the lane layout and packed points; n_row rows of eight points.
void pack_points(const double* from, std::size_t n_row, Packed<double>* to);
void pack_points(const float* from, std::size_t n_row, Packed<float>* to);
void add_packed(const Packed<double>* from, std::size_t n_row, double* to);
void add_packed(const Packed<float>* from, std::size_t n_row, float* to);

}  // namespace acinus::solve
