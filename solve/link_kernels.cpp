#include "solve/link_kernels.hpp"

#include <cstddef>

namespace acinus::solve {
namespace {

template <class T>
ACINUS_INLINE void add4(Packed<T>* v, Point p, Four<T> f) {
  store4<T>(v + p, load4(v + p) + f);
}

/// Normal of a contact, with the next member of the struct in the fourth place: that number is
/// multiplied by the zero that vectors hold there, and its product never read.
template <class T, class L>
ACINUS_INLINE Four<T> load_normal(const L& l) {
  static_assert(offsetof(L, stiffness) == offsetof(L, normal) + sizeof(l.normal));
  Four<float> n;
  __builtin_memcpy(&n, &l.normal, sizeof(n));
  return __builtin_convertvector(n, Four<T>);
}

ACINUS_INLINE bool exists(const Link& l) { return l.b.point[0] != kNowhere; }
ACINUS_INLINE bool exists(const PointLink& l) { return l.b != kNowhere; }

/// Position, or other vector, at a side: weighted mean over its points.
template <class T>
ACINUS_INLINE Four<T> gather(const Side& s, const Packed<T>* x) {
  const Four<T> last = load4(x + s.point[2]);
  const T w0 = static_cast<T>(s.weight[0]), w1 = static_cast<T>(s.weight[1]);
  return last + w0 * (load4(x + s.point[0]) - last) + w1 * (load4(x + s.point[1]) - last);
}
template <class T>
ACINUS_INLINE Four<T> gather(Point p, const Packed<T>* x) {
  return load4(x + p);
}

/// Distributes a force over the points of a side; their shares add up to it exactly.
template <class T>
ACINUS_INLINE void scatter(const Side& s, Four<T> f, Packed<T>* y) {
  const Four<T> f0 = static_cast<T>(s.weight[0]) * f, f1 = static_cast<T>(s.weight[1]) * f;
  add4(y, s.point[0], f0);
  add4(y, s.point[1], f1);
  add4(y, s.point[2], f - f0 - f1);
}
template <class T>
ACINUS_INLINE void scatter(Point p, Four<T> f, Packed<T>* y) {
  add4(y, p, f);
}

template <class L, class T>
ACINUS_INLINE void multiply(const L& l, const LinkScales& s, bool to_a, bool to_b,
                            const Packed<T>* x, Packed<T>* y) {
  const bool pair = exists(l);
  Four<T> r = gather(l.a, x);
  if (pair) r -= gather(l.b, x);
  const T k = static_cast<T>(s.stiffness) * static_cast<T>(l.stiffness);
  const T g = static_cast<T>(s.friction) * static_cast<T>(l.friction);
  const Four<T> n = load_normal<T>(l);
  const Four<T> nr = n * r;
  const Four<T> f = (k * (nr[0] + nr[1] + nr[2])) * n + g * r;
  if (to_a) scatter(l.a, f, y);
  if (pair && to_b) scatter(l.b, -f, y);
}

template <class L, class T>
ACINUS_INLINE void multiply_all(const LinkSet<L>& set, const LinkScales& scales, const Packed<T>* x,
                                Packed<T>* y) {
  for (const LargeVector<Share>& list : set.share)
    for (const Share s : list) multiply(set.link[s.link], scales, s.a != 0, s.b != 0, x, y);
}

ACINUS_INLINE void add_block(SymBlock* to, Point p, float w, const SymBlock& m) {
  float* at = to[p].data();
  const float w2 = w * w;
  for (std::size_t k = 0; k < 8; ++k) at[k] += w2 * m[k];
}
ACINUS_INLINE void add_side(SymBlock* to, const Side& s, const SymBlock& m) {
  if (s.is_single()) {
    add_block(to, s.point[2], 1, m);
    return;
  }
  const float w0 = s.weight[0], w1 = s.weight[1];
  add_block(to, s.point[0], w0, m);
  add_block(to, s.point[1], w1, m);
  add_block(to, s.point[2], 1 - w0 - w1, m);
}
ACINUS_INLINE void add_side(SymBlock* to, Point p, const SymBlock& m) { add_block(to, p, 1, m); }

template <class L>
ACINUS_INLINE void add_diagonal_of(const LinkSet<L>& set, const LinkScales& scales, SymBlock* d) {
  for (const LargeVector<Share>& list : set.share)
    for (const Share s : list) {
      const L& l = set.link[s.link];
      const SymBlock m = matrix_of(l, scales);
      if (s.a) add_side(d, l.a, m);
      if (s.b && exists(l)) add_side(d, l.b, m);
    }
}

template <class T>
ACINUS_INLINE void pack(const T* from, std::size_t n_row, Packed<T>* to) {
  for (std::size_t row = 0; row < n_row; ++row, from += kPointStride, to += kLanes)
    store_packed(to, load3<T>(from));
}

template <class T>
ACINUS_INLINE void unpack(const Packed<T>* from, std::size_t n_row, T* to) {
  for (std::size_t row = 0; row < n_row; ++row, to += kPointStride, from += kLanes)
    add3(to, load_packed(from));
}

}  // namespace

ACINUS_KERNEL void multiply_links(const LinkSet<Link>& set, LinkScales scales,
                                  const Packed<double>* x, Packed<double>* y) {
  multiply_all(set, scales, x, y);
}
ACINUS_KERNEL void multiply_links(const LinkSet<Link>& set, LinkScales scales,
                                  const Packed<float>* x, Packed<float>* y) {
  multiply_all(set, scales, x, y);
}
ACINUS_KERNEL void multiply_links(const LinkSet<PointLink>& set, LinkScales scales,
                                  const Packed<double>* x, Packed<double>* y) {
  multiply_all(set, scales, x, y);
}
ACINUS_KERNEL void multiply_links(const LinkSet<PointLink>& set, LinkScales scales,
                                  const Packed<float>* x, Packed<float>* y) {
  multiply_all(set, scales, x, y);
}

ACINUS_KERNEL void multiply_pairs(const PointPairs& pairs, const ShareLists& share,
                                  const Packed<float>* x, Packed<float>* y) {
  using Eight = float __attribute__((vector_size(32)));
  for (const LargeVector<Share>& list : share)
    for (const Share s : list) {
      const PointPairs::Row row = pairs.row[s.link];
      const Four<float> xa = load4(x + row.a);
      Four<float> sum = {};
      for (std::uint32_t k = row.first; k < row.last; ++k) {
        const Point b = pairs.b[k];
        const Four<float> r = xa - load4(x + b);
        Eight m;
        __builtin_memcpy(&m, pairs.block[k].data(), sizeof(m));
        // The columns of the block; what they hold in the fourth place is not read.
        const Four<float> f = r[0] * __builtin_shufflevector(m, m, 0, 1, 2, 6) +
                              r[1] * __builtin_shufflevector(m, m, 1, 3, 4, 6) +
                              r[2] * __builtin_shufflevector(m, m, 2, 4, 5, 6);
        sum += f;
        if (s.b) add4(y, b, -f);
      }
      if (s.a) add4(y, row.a, sum);
    }
}

void add_forces(const LinkSet<Link>& set, const LinkForce& force, bool external,
                Packed<double>* y) {
  for (const LargeVector<Share>& list : set.share)
    for (const Share s : list) {
      const Link& l = set.link[s.link];
      if (exists(l) == external) continue;
      const Vec3 v = force(s.link);
      const Four<double> f = {v.x(), v.y(), v.z(), 0};
      if (s.a) scatter(l.a, f, y);
      if (s.b && !external) scatter(l.b, -f, y);
    }
}

ACINUS_KERNEL void add_diagonal(const LinkSet<Link>& set, LinkScales scales, SymBlock* d) {
  add_diagonal_of(set, scales, d);
}
ACINUS_KERNEL void add_diagonal(const LinkSet<PointLink>& set, LinkScales scales, SymBlock* d) {
  add_diagonal_of(set, scales, d);
}

ACINUS_KERNEL void pack_points(const double* from, std::size_t n_row, Packed<double>* to) {
  pack(from, n_row, to);
}
ACINUS_KERNEL void pack_points(const float* from, std::size_t n_row, Packed<float>* to) {
  pack(from, n_row, to);
}
ACINUS_KERNEL void add_packed(const Packed<double>* from, std::size_t n_row, double* to) {
  unpack(from, n_row, to);
}
ACINUS_KERNEL void add_packed(const Packed<float>* from, std::size_t n_row, float* to) {
  unpack(from, n_row, to);
}

}  // namespace acinus::solve
