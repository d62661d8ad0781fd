#pragma once
/// Contacts at work: products, forces and diagonal blocks, on packed points.

#include <array>
#include <span>
#include <vector>

#include "core/solve/links.hpp"

namespace acinus::solve {

/// The components of a point side by side; the fourth number is unused.
template <class T>
using Packed = std::array<T, 4>;

/// A contact as one thread sees it: which of its sides it owns.
struct Share {
  std::uint32_t link : 30;
  std::uint32_t a : 1, b : 1;
};

/// One thread's share of the contacts.
template <class L>
struct LinkSet {
  std::span<const L> link;
  std::span<const Share> share;
};

/// What contact coefficients are multiplied by.
struct LinkScales {
  double stiffness = 1, friction = 1;
};

/// y += (stiffness n n^T + friction I) r, spread over the points of each contact.
void multiply_links(const LinkSet<Link>& set, LinkScales scales, const Packed<double>* x,
                    Packed<double>* y);
void multiply_links(const LinkSet<Link>& set, LinkScales scales, const Packed<float>* x,
                    Packed<float>* y);
void multiply_links(const LinkSet<PointLink>& set, LinkScales scales, const Packed<double>* x,
                    Packed<double>* y);
void multiply_links(const LinkSet<PointLink>& set, LinkScales scales, const Packed<float>* x,
                    Packed<float>* y);

/// y += force of contacts between cells, or of contacts with surroundings.
void add_forces(const LinkSet<Link>& set, std::span<const LinkLoad> load, bool external,
                Packed<double>* y);

/// xx, xy, xz, yy, yz, zz of a point's diagonal block, and two unused.
using DiagonalBlock = std::array<float, 8>;
void add_diagonal(const LinkSet<Link>& set, LinkScales scales, DiagonalBlock* diagonal);
void add_diagonal(const LinkSet<PointLink>& set, LinkScales scales, DiagonalBlock* diagonal);

/// Lane layout to packed points and back; n_row rows of eight points.
void pack_points(const double* from, std::size_t n_row, Packed<double>* to);
void pack_points(const float* from, std::size_t n_row, Packed<float>* to);
void add_packed(const Packed<double>* from, std::size_t n_row, double* to);
void add_packed(const Packed<float>* from, std::size_t n_row, float* to);

}  // namespace acinus::solve
