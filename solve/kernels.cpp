#include "solve/kernels.hpp"

#include <type_traits>

namespace acinus::solve {
namespace {

// One body for both number types; the exported functions below instantiate it for every
// instruction set.

template <class T>
ACINUS_INLINE Lane3Of<T> sym_times(const float* d, const Lane3Of<T>& v) {
  const LaneOf<T> xy = load<T>(d + kLanes), xz = load<T>(d + 2 * kLanes),
                  yz = load<T>(d + 4 * kLanes);
  return {load<T>(d) * v.x + xy * v.y + xz * v.z,
          xy * v.x + load<T>(d + 3 * kLanes) * v.y + yz * v.z,
          xz * v.x + yz * v.y + load<T>(d + 5 * kLanes) * v.z};
}

/// Vectors g of a hinge on its wings and on the first point of its spring.
template <class T>
struct HingeVectors {
  Lane3Of<T> wing0, wing1, end;
};
/// @param d, sj  difference of the shape along the hinge's spring, and its second point
template <class T>
ACINUS_INLINE HingeVectors<T> load_hinge(const BlockView& b, std::size_t hinge, const Lane3Of<T>& d,
                                         const Lane3Of<T>& sj) {
  const float* const h = b.hinge + hinge * kHingeStride;
  const auto& [p, q] = b.pattern->wing[hinge];
  const Lane3Of<T> n1 = cross(d, load3<T>(b.shape + p * kPointStride) - sj);
  const Lane3Of<T> n2 = cross(load3<T>(b.shape + q * kPointStride) - sj, d);
  return {load<T>(h) * n1, load<T>(h + kLanes) * n2,
          load<T>(h + 2 * kLanes) * n1 + load<T>(h + 3 * kLanes) * n2};
}

/// Product with springs and the hinge about each, in one sweep: they share two of their points.
template <class T, bool kHinges, bool kMerged>
ACINUS_INLINE void add_edges(const BlockView& b, const T* x, T* y) {
  const auto& spring = b.pattern->spring;
  const float* e = kMerged ? b.edge : b.spring;
  for (std::size_t k = 0; k < spring.size(); ++k) {
    const int i = spring[k][0] * kPointStride, j = spring[k][1] * kPointStride;
    const Lane3Of<T> xj = load3<T>(x + j);
    const Lane3Of<T> r = xj - load3<T>(x + i);
    const Lane3Of<T> sj = load3<T>(b.shape + j), d = sj - load3<T>(b.shape + i);
    Lane3Of<T> f;
    if constexpr (kMerged) {
      f = sym_times(e, r);
      e += kEdgeStride;
    } else {
      f = (load<T>(e) * dot(d, r)) * d + load<T>(e + kLanes) * r;
      e += kSpringStride;
    }
    if constexpr (kHinges) {
      const int p = b.pattern->wing[k][0] * kPointStride, q = b.pattern->wing[k][1] * kPointStride;
      const auto [g1, g2, g3] = load_hinge<T>(b, k, d, sj);
      const LaneOf<T> s =
          dot(g1, load3<T>(x + p) - xj) + dot(g2, load3<T>(x + q) - xj) - dot(g3, r);
      const Lane3Of<T> f1 = s * g1, f2 = s * g2, f3 = s * g3;
      add3(y + p, f1);
      add3(y + q, f2);
      add3(y + i, f3 - f);
      add3(y + j, f - (f1 + f2 + f3));
    } else {
      add3(y + j, f);
      add3(y + i, -f);
    }
  }
}

template <class T>
ACINUS_INLINE void add_faces(const BlockView& b, const T* x, T* y) {
  const float* e = b.face;
  for (const auto& f : b.pattern->face) {
    const Lane3Of<T> last = load3<T>(x + f[2] * kPointStride);
    const Lane3Of<T> g1 = load3<T>(e), g2 = load3<T>(e + 3 * kLanes);
    const LaneOf<T> s = dot(g1, load3<T>(x + f[0] * kPointStride) - last) +
                        dot(g2, load3<T>(x + f[1] * kPointStride) - last);
    const Lane3Of<T> f1 = s * g1, f2 = s * g2;
    add3(y + f[0] * kPointStride, f1);
    add3(y + f[1] * kPointStride, f2);
    add3(y + f[2] * kPointStride, -(f1 + f2));
    e += kFaceStride;
  }
}

template <class T>
ACINUS_INLINE void add_beams(const BlockView& b, const T* x, T* y) {
  const float* e = b.beam;
  for (const auto& beam : b.pattern->beam) {
    std::array<int, 4> at{};
    for (std::size_t k = 0; k < at.size(); ++k) at[k] = beam[k] * kPointStride;
    const Lane3Of<T> apart = load3<T>(x + at[1]) - load3<T>(x + at[0]);
    const Lane3Of<T> turn = load3<T>(x + at[2]) + load3<T>(x + at[3]);
    for (int direction = 0; direction < 2; ++direction, e += 6 * kLanes) {
      const Lane3Of<T> end = load3<T>(e), rotation = load3<T>(e + 3 * kLanes);
      const LaneOf<T> s = dot(end, apart) + dot(rotation, turn);
      add3(y + at[0], -(s * end));
      add3(y + at[1], s * end);
      add3(y + at[2], s * rotation);
      add3(y + at[3], s * rotation);
    }
  }
}

template <class T>
ACINUS_INLINE double multiply(const BlockView& b, const T* x, const Packed<T>* contact, T* y) {
  const int n_point = b.pattern->n_point;
  const T scale = static_cast<T>(b.friction_scale);
  LaneOf<T> along[kMaxFamilies] = {};
  for (int i = 0; i < n_point; ++i) {
    const Lane3Of<T> xi = load3<T>(x + i * kPointStride);
    const LaneOf<T> friction = scale * load<T>(b.medium + i * kLanes);
    store3(y + i * kPointStride, friction * xi + load_packed<T>(contact + i * kLanes));
    for (std::size_t k = 0; k < b.n_family; ++k)
      along[k] += dot(load3<T>(b.vector[k] + i * kPointStride), xi);
  }
  for (std::size_t k = 0; k < b.n_family; ++k) along[k] *= load<T>(b.coefficient[k]);
  if (std::is_same_v<T, float> && b.edge) {
    if (b.pattern->wing.empty())
      add_edges<T, false, true>(b, x, y);
    else
      add_edges<T, true, true>(b, x, y);
  } else if (b.pattern->wing.empty()) {
    add_edges<T, false, false>(b, x, y);
  } else {
    add_edges<T, true, false>(b, x, y);
  }
  add_faces(b, x, y);
  if (!b.pattern->beam.empty()) add_beams(b, x, y);
  LaneOf<T> product = {};
  for (int i = 0; i < n_point; ++i) {
    Lane3Of<T> yi = load3<T>(y + i * kPointStride);
    for (std::size_t k = 0; k < b.n_family; ++k)
      yi = yi + along[k] * load3<T>(b.vector[k] + i * kPointStride);
    store3(y + i * kPointStride, yi);
    product += dot(load3<T>(x + i * kPointStride), yi);
  }
  return sum_lanes<T>(product);
}

/// Subtracts the rank-one parts from z = D^-1 r, given `along` = u . r; returns the change of r .
/// z.
template <class T>
ACINUS_INLINE LaneOf<T> take_off(const InverseView& b, const LaneOf<T>* along, T* z) {
  LaneOf<T> s = {};
  for (std::size_t k = 0; k < b.n_family; ++k) s -= along[k] * along[k];
  if (z)
    for (int at = 0; at < b.n_point * kPointStride; at += kLanes) {
      LaneOf<T> v = load<T>(z + at);
      for (std::size_t k = 0; k < b.n_family; ++k) v -= along[k] * load<T>(b.vector[k] + at);
      store(z + at, v);
    }
  return s;
}

template <class T>
ACINUS_INLINE double precondition(const InverseView& b, const T* r, T* z) {
  LaneOf<T> s = {}, along[kMaxFamilies] = {};
  for (int i = 0; i < b.n_point; ++i) {
    const int at = i * kPointStride;
    const Lane3Of<T> ri = load3<T>(r + at);
    const Lane3Of<T> zi = sym_times(b.diagonal + i * kSymStride, ri);
    if (z) store3(z + at, zi);
    s += dot(ri, zi);
    for (std::size_t k = 0; k < b.n_family; ++k) along[k] += dot(load3<T>(b.vector[k] + at), ri);
  }
  if (b.n_family > 0) s += take_off(b, along, z);
  return sum_lanes<T>(s);
}

template <class T>
ACINUS_INLINE double descend(const InverseView& b, double step, const DescentBlock<T>& v) {
  const auto [p, q, x, r, z] = v;
  const T alpha = static_cast<T>(step);
  LaneOf<T> s = {}, along[kMaxFamilies] = {};
  for (int i = 0; i < b.n_point; ++i) {
    const int at = i * kPointStride;
    for (int c = 0; c < kPointStride; c += kLanes)
      store(x + at + c, load<T>(x + at + c) + alpha * load<T>(p + at + c));
    Lane3Of<T> ri;
    ri.x = load<T>(r + at) - alpha * load<T>(q + at);
    ri.y = load<T>(r + at + kLanes) - alpha * load<T>(q + at + kLanes);
    ri.z = load<T>(r + at + 2 * kLanes) - alpha * load<T>(q + at + 2 * kLanes);
    store3(r + at, ri);
    const Lane3Of<T> zi = sym_times(b.diagonal + i * kSymStride, ri);
    store3(z + at, zi);
    s += dot(ri, zi);
    for (std::size_t k = 0; k < b.n_family; ++k) along[k] += dot(load3<T>(b.vector[k] + at), ri);
  }
  if (b.n_family > 0) s += take_off(b, along, z);
  return sum_lanes<T>(s);
}

template <class T>
ACINUS_INLINE double dot_of(const T* a, const T* b, std::size_t n) {
  LaneOf<T> s = {};
  for (std::size_t k = 0; k < n; k += kLanes) s += load<T>(a + k) * load<T>(b + k);
  return sum_lanes<T>(s);
}

template <class T>
ACINUS_INLINE void redirect(const T* z, double b, T* p, std::size_t n) {
  const T beta = static_cast<T>(b);
  for (std::size_t k = 0; k < n; k += kLanes) store(p + k, load<T>(z + k) + beta * load<T>(p + k));
}

}  // namespace

BlockView view_block(const System& s, std::size_t b, const float* edge) {
  const Block& block = s.block[b];
  BlockView view{block.pattern,
                 s.medium.data() + block.first_row * kLanes,
                 s.shape.data() + block.first_shape * kPointStride,
                 s.spring.data() + block.first_spring * kSpringStride,
                 edge ? edge + block.first_spring * kEdgeStride : nullptr,
                 s.hinge.data() + block.first_hinge * kHingeStride,
                 s.face.data() + block.first_face * kFaceStride,
                 s.beam.data() + block.first_beam * kBeamStride,
                 s.friction_scale,
                 block.dashpot,
                 block.dashpot_across,
                 0,
                 {},
                 {}};
  for (const RankOne& family : s.rank_one) {
    if (block.still || b * kLanes >= family.coefficient.size()) continue;
    view.vector[view.n_family] = family.vector.data() + block.first_row * kPointStride;
    view.coefficient[view.n_family++] = family.coefficient.data() + b * kLanes;
  }
  return view;
}

ACINUS_KERNEL double multiply_block(const BlockView& b, const double* x,
                                    const Packed<double>* contact, double* y) {
  return multiply<double>(b, x, contact, y);
}
ACINUS_KERNEL double multiply_block(const BlockView& b, const float* x,
                                    const Packed<float>* contact, float* y) {
  return multiply<float>(b, x, contact, y);
}

ACINUS_KERNEL void multiply_friction(const BlockView& b, const double* x,
                                     const Packed<double>* contact, double* y) {
  for (int i = 0; i < b.pattern->n_point; ++i)
    store3(y + i * kPointStride,
           (b.friction_scale * load(b.medium + i * kLanes)) * load3(x + i * kPointStride) +
               load_packed<double>(contact + i * kLanes));
  if (!(b.dashpot > 0)) return;
  const Lane friction = lane_of(b.friction_scale * b.dashpot);
  for (const auto& [first, second] : b.pattern->spring) {
    const int i = first * kPointStride, j = second * kPointStride;
    const Lane3 r = load3(x + j) - load3(x + i);
    Lane3 f = friction * r;
    if (b.dashpot_across != 1) {
      const Lane3 d = load3(b.shape + j) - load3(b.shape + i);
      const double s = b.dashpot_across;
      f = (s * friction) * r + ((1 - s) * friction * dot(d, r) / dot(d, d)) * d;
    }
    add3(y + j, f);
    add3(y + i, -f);
  }
}

ACINUS_KERNEL void add_diagonal(const BlockView& b, double* d) {
  const BlockPattern& pattern = *b.pattern;
  for (int i = 0; i < pattern.n_point; ++i)
    add_identity_sym(d + i * kSymStride, b.friction_scale * load(b.medium + i * kLanes));
  const Lane one = lane_of(1);
  const float* e = b.spring;
  for (std::size_t k = 0; k < pattern.spring.size(); ++k, e += kSpringStride) {
    const auto& [i, j] = pattern.spring[k];
    const Lane3 sj = load3(b.shape + j * kPointStride), r = sj - load3(b.shape + i * kPointStride);
    const Lane a = load(e), c = load(e + kLanes);
    for (int end : {i, j}) {
      add_outer_sym(d + end * kSymStride, a, r);
      add_identity_sym(d + end * kSymStride, c);
    }
    if (pattern.wing.empty()) continue;
    const auto [g1, g2, g3] = load_hinge<double>(b, k, r, sj);
    add_outer_sym(d + pattern.wing[k][0] * kSymStride, one, g1);
    add_outer_sym(d + pattern.wing[k][1] * kSymStride, one, g2);
    add_outer_sym(d + i * kSymStride, one, g3);
    add_outer_sym(d + j * kSymStride, one, g1 + g2 + g3);
  }
  e = b.face;
  for (const auto& f : pattern.face) {
    const Lane3 g1 = load3(e), g2 = load3(e + 3 * kLanes);
    add_outer_sym(d + f[0] * kSymStride, one, g1);
    add_outer_sym(d + f[1] * kSymStride, one, g2);
    add_outer_sym(d + f[2] * kSymStride, one, g1 + g2);
    e += kFaceStride;
  }
  e = b.beam;
  for (const auto& beam : pattern.beam)
    for (int direction = 0; direction < 2; ++direction, e += 6 * kLanes)
      for (std::size_t k = 0; k < beam.size(); ++k)
        add_outer_sym(d + beam[k] * kSymStride, one, load3(k < 2 ? e : e + 3 * kLanes));
}

ACINUS_KERNEL void invert_blocks(int n_point, const double* d, float* out) {
  for (int i = 0; i < n_point; ++i, d += kSymStride, out += kSymStride) {
    const Lane xy = load(d + kLanes), xz = load(d + 2 * kLanes), yz = load(d + 4 * kLanes);
    const Lane more = kRegularise * (load(d) + load(d + 3 * kLanes) + load(d + 5 * kLanes));
    const Lane xx = load(d) + more, yy = load(d + 3 * kLanes) + more,
               zz = load(d + 5 * kLanes) + more;
    const Lane cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
    const Lane r = 1.0 / (xx * cxx + xy * cxy + xz * cxz);
    store(out, cxx * r);
    store(out + kLanes, cxy * r);
    store(out + 2 * kLanes, cxz * r);
    store(out + 3 * kLanes, (xx * zz - xz * xz) * r);
    store(out + 4 * kLanes, (xy * xz - xx * yz) * r);
    store(out + 5 * kLanes, (xx * yy - xy * xy) * r);
  }
}

ACINUS_KERNEL void invert_rank_one(const InverseView& known, const float* vector,
                                   const double* coefficient, float* u) {
  Lane along[kMaxFamilies] = {};
  for (int i = 0; i < known.n_point; ++i)
    for (std::size_t k = 0; k < known.n_family; ++k)
      along[k] += dot(load3(known.vector[k] + i * kPointStride), load3(vector + i * kPointStride));
  auto inverse_times_vector = [&](int i) {
    Lane3 w = sym_times(known.diagonal + i * kSymStride, load3(vector + i * kPointStride));
    for (std::size_t k = 0; k < known.n_family; ++k)
      w = w - along[k] * load3(known.vector[k] + i * kPointStride);
    return w;
  };
  Lane size = {};
  for (int i = 0; i < known.n_point; ++i)
    size += dot(inverse_times_vector(i), load3(vector + i * kPointStride));
  const Lane c = load(coefficient);
  const Lane scale = lane_sqrt((1 - kRegularise) * c / (1.0 + c * size));
  for (int i = 0; i < known.n_point; ++i)
    store3(u + i * kPointStride, scale * inverse_times_vector(i));
}

ACINUS_KERNEL double precondition_block(const InverseView& inverse, const double* r, double* z) {
  return precondition<double>(inverse, r, z);
}
ACINUS_KERNEL double precondition_block(const InverseView& inverse, const float* r, float* z) {
  return precondition<float>(inverse, r, z);
}

ACINUS_KERNEL double descend_block(const InverseView& inverse, double alpha,
                                   const DescentBlock<double>& v) {
  return descend<double>(inverse, alpha, v);
}
ACINUS_KERNEL double descend_block(const InverseView& inverse, double alpha,
                                   const DescentBlock<float>& v) {
  return descend<float>(inverse, alpha, v);
}

ACINUS_KERNEL double dot_range(const double* a, const double* b, std::size_t n) {
  return dot_of<double>(a, b, n);
}
ACINUS_KERNEL double dot_range(const float* a, const float* b, std::size_t n) {
  return dot_of<float>(a, b, n);
}

ACINUS_KERNEL void redirect_range(const double* z, double beta, double* p, std::size_t n) {
  redirect<double>(z, beta, p, n);
}
ACINUS_KERNEL void redirect_range(const float* z, double beta, float* p, std::size_t n) {
  redirect<float>(z, beta, p, n);
}

}  // namespace acinus::solve
