#pragma once
/// Matrix of a System as an operator, with its preconditioner: 3x3 diagonal blocks, and the
/// rank-one terms (volume and area of a cell) whole.

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "solve/kernels.hpp"
#include "solve/link_kernels.hpp"
#include "solve/merged_links.hpp"
#include "solve/point_exchange.hpp"
#include "solve/system.hpp"

namespace acinus::solve {

/// Contact whose stiffness changed.
struct LinkChange {
  std::uint32_t link = 0;
  double stiffer = 0;   ///< nN/um, change of its stiffness in the matrix
  bool gained = false;  ///< it has a matrix for the first time since prepare
};

/// Operator of a System, prepared for products. T is double or float: iterations may run in float,
/// all results are double. Vectors are [n_row][3][lane].
///
/// Threads and processes: each owns some blocks and adds to nothing else; a contact that joins
/// blocks of two owners is computed by both. A point's sum runs over its contacts in their order,
/// and sums over blocks are exact, so the bits do not depend on the owners. Only products read
/// points of other owners (ghost points), and get them themselves; the rest of a vector is neither
/// read nor written.
class Operator {
 public:
  template <class T>
  using In = std::type_identity_t<std::span<const T>>;
  template <class T>
  using Out = std::type_identity_t<std::span<T>>;

  Operator() = default;
  Operator(const Operator&) = delete;  // it points at a system beside it
  Operator& operator=(const Operator&) = delete;

  /// Prepares the products for a system; call again after its loads changed. Cost: linear in
  /// elements and links.
  void prepare(const System& system);

  /// Brings products and diagonal blocks of the preconditioner up to date after changes of the
  /// stiffness of few links. Cost: linear in the changes.   @param changes  ascending
  void update_links(std::span<const LinkChange> changes);

  /// Five vectors of floats, [n_row][3][lane], for the caller between two products in double, which
  /// use their memory.
  std::array<std::span<float>, 5> float_vectors() const;

  /// Frees what prepare makes anew: the merged contacts and the scratch of products. The next call
  /// is to be prepare or add_link_forces.
  void release();

  /// Product y = A x; returns x . y. Collective, like all functions that return a sum over all
  /// cells.
  template <class T = double>
  double apply(In<T> x, Out<T> y) const;

  /// Makes further products in float cheaper: contacts are merged into pairs of points (see
  /// merged_links.hpp). Costs as much as about ten products save. Changes products by rounding
  /// only. Does nothing if that was done since prepare.
  void merge_links();

  /// Preconditioner z = M^-1 r; returns r . z. z may be empty.
  template <class T = double>
  double precondition(In<T> r, Out<T> z) const;

  /// Update of conjugate gradients: x += alpha p, r -= alpha q, z = M^-1 r; returns r . z.
  template <class T = double>
  double descend(double alpha, In<T> p, In<T> q, Out<T> x, Out<T> r, Out<T> z) const;

  /// New direction p = z + beta p.
  template <class T = double>
  void redirect(In<T> z, double beta, Out<T> p) const;

  /// Dot product over all processes.
  template <class T = double>
  double dot(In<T> a, In<T> b) const;

  /// Product y = A x without contacts: medium and elements within the cells.
  void apply_within(std::span<const double> x, std::span<double> y) const;

  /// Product y = A_external x: friction with the medium and contacts with boundary only.
  void apply_external(std::span<const double> x, std::span<double> y) const;

  /// Friction part of the product, y = Gamma/h x; then the part of it that is with the boundary.
  void apply_friction(std::span<const double> x, std::span<double> y) const;
  void apply_external_friction(std::span<const double> x, std::span<double> y) const;

  /// Calls f(stencil, link) for every contact of own points with boundary that has a matrix; those
  /// of one point come in their order.
  template <class F>
  void for_each_external(const F& f) const {
    for (const ThreadRange& range : range_)
      for (const std::uint32_t l : range.external)
        f(stencil_of(system_->links.link[l]), system_->links.link[l]);
    for (const ThreadRange& range : range_)
      for (const std::uint32_t l : range.external_point) {
        const PointLink& link = system_->point_links[l];
        f(Stencil{1, {address_of(link.a)}, {1}}, link);
      }
  }

  /// Gets the ghost points: points of other processes that own ones are in contact with.
  void fetch(std::span<double> x) const { exchange_.fetch(x); }

  /// Adds the force of every link to its points: to force, or to external_force where one side is
  /// boundary. Changes the right-hand side, not the matrix: prepare comes after.
  void add_link_forces(System& system, const LinkForce& force);

  /// Ghost points of the present contacts.
  std::span<const Point> ghost_points() const { return exchange_.ghost_points(); }

  /// Calls f(array) for all arrays over rows.
  template <class F>
  void for_each_row_array(const F& f) {
    f(inverse_);
    f(scratch_);
    f(merge_.edge);
    for (RowVector<float>& u : rank_one_) f(u);
  }

  /// Memory of all that is not an array over rows, bytes.
  std::size_t memory() const;

  const System& system() const { return *system_; }
  std::size_t n_sent_points() const { return exchange_.n_sent(); }  ///< sent in one product

 private:
  /// Own blocks of one thread, with their contacts.
  struct ThreadRange {
    std::size_t first_block = 0, last_block = 0;
    ShareLists link, point_link;
    ShareLists single, pair;  ///< in float: links that are not merged, and rows of pairs
    std::vector<std::uint32_t> external, external_point;  ///< links with boundary
  };
  /// Scratch of a product: two vectors on packed points, [n_point] each.
  template <class T>
  struct PackedVectors {
    Packed<T>*x, *y;
  };
  template <class T>
  PackedVectors<T> packed() const;
  /// Scratch with x in the first vector and zero in the second.
  template <class T>
  PackedVectors<T> pack(In<T> x) const;
  SymBlock* diagonal() const;
  void start(const System& system);
  void divide();
  template <class Ends>
  void share(std::size_t n, ShareLists ThreadRange::*to, const Ends& ends);
  void share_links(bool with_matrix);
  void add_share(std::uint32_t link);
  void stiffen(Address point, double stiffness, const Vec3& normal);
  int range_of(Point p) const { return p == kNowhere ? -1 : range_of_row_[p / kLanes] - 1; }
  void compute_inverse();
  LinkSet<Link> links_of(const ThreadRange& range) const;
  LinkSet<PointLink> point_links_of(const ThreadRange& range) const;
  template <class F>
  void for_each_range(F f);
  template <class F>
  void for_each_range(F f) const;
  /// Sum over all processes of the numbers that f(range, sum) adds for every range.
  template <class F>
  double sum_ranges(F f) const;
  /// Calls f(block, first point row, number of points) for the blocks of a range.
  template <class F>
  void for_each_block(const ThreadRange& range, F f) const;
  InverseView inverse_of(std::size_t block) const;
  void apply_external(std::span<const double> x, std::span<double> y, LinkScales scales) const;

  const System* system_ = nullptr;
  std::vector<ThreadRange> range_;
  RowVector<int> range_of_row_;  ///< [n_row] range + 1, 0: of another process
  bool merged_ = false;          ///< products in float use merge_
  LinkMerger merger_;
  MergedLinks merge_;
  RowVector<float> inverse_;  ///< [n_row][6][lane]
  /// [family][rows of its blocks][3][lane] vectors u of InverseView.
  std::vector<RowVector<float>> rank_one_;
  PointExchange exchange_;
  /// Scratch of two parts. First: a packed vector in double, two in float, or the diagonal blocks.
  /// Second: the vectors of floats, or another packed vector in double.
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  mutable RowVector<Line> scratch_;
};

}  // namespace acinus::solve
