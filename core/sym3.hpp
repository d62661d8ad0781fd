#pragma once
/// Symmetric 3x3 matrices as six numbers.

#include "core/vec.hpp"

namespace acinus {

struct Sym3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  static Sym3 identity(double s) { return {s, 0, 0, s, 0, s}; }
  static Sym3 outer(double s, const Vec3& n) {
    return {s * n.x() * n.x(), s * n.x() * n.y(), s * n.x() * n.z(),
            s * n.y() * n.y(), s * n.y() * n.z(), s * n.z() * n.z()};
  }
  Vec3 operator*(const Vec3& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }
  Sym3& operator+=(const Sym3& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    return *this;
  }
  friend Sym3 operator+(Sym3 a, const Sym3& b) { return a += b; }
  friend Sym3 operator*(double s, const Sym3& a) {
    return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
  }
};

/// Axially symmetric tensor g_n n n^T + g_t (I - n n^T). [VanLiedekerke2020, Eq. (2)]
inline Sym3 axial(double along, double across, const Vec3& n) {
  return Sym3::outer(along - across, n) + Sym3::identity(across);
}

/// Inverse of a symmetric positive definite matrix.
inline Sym3 inverse(const Sym3& m) {
  const double cxx = m.yy * m.zz - m.yz * m.yz;
  const double cxy = m.xz * m.yz - m.xy * m.zz;
  const double cxz = m.xy * m.yz - m.xz * m.yy;
  const double d = 1.0 / (m.xx * cxx + m.xy * cxy + m.xz * cxz);
  return {cxx * d,
          cxy * d,
          cxz * d,
          (m.xx * m.zz - m.xz * m.xz) * d,
          (m.xy * m.xz - m.xx * m.yz) * d,
          (m.xx * m.yy - m.xy * m.xy) * d};
}

}  // namespace acinus
