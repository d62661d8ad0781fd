#pragma once
/// One grid of the multigrid method: the matrix (own + sum of face conductances) on the diagonal,
/// -conductance beside it, and its kernels. Conductances are products of widths, or with obstacles
/// one number per face.
///
/// Rows along x are padded to whole lanes with a leading lane of zeros, so that kernels read
/// neighbours without branches: at(i, j, k) = first + (k n_y + j) stride + i.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/numbers/lanes.hpp"

namespace acinus::substances {

/// Places of padded voxels.
struct PaddedLayout {
  std::array<int, 3> n{0, 0, 0};
  std::size_t stride = 0;  ///< numbers per row
  std::size_t size = 0;    ///< numbers per array

  std::size_t row(int j, int k) const {
    return kLanes + (static_cast<std::size_t>(k) * static_cast<std::size_t>(n[1]) +
                     static_cast<std::size_t>(j)) *
                        stride;
  }
  std::size_t n_voxel() const {
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
           static_cast<std::size_t>(n[2]);
  }
};
PaddedLayout make_layout(const std::array<int, 3>& n);

/// Matrix on a grid whose voxels have widths relative to those of the finest grid.
template <class T>
struct Level {
  PaddedLayout layout;
  std::array<std::vector<double>, 3> width;     ///< per axis, [n]
  std::array<std::vector<double>, 3> face;      ///< per axis, [n + 1]; conductance below voxel i
                                                ///< per area of a fine face; 0 at both ends
  std::vector<T> face_low, face_high, width_x;  ///< along x, [stride] in lanes
  /// With obstacles, per axis: conductance of the face below each voxel, [size]; else empty.
  std::array<std::vector<T>, 3> partial;
  std::vector<T> no_faces;  ///< [stride] zeros, faces above the last rows
  std::vector<T> diagonal;  ///< [size]
  std::vector<T> inverse;   ///< [size], 0 in the padding and in voxels without diagonal; single
                            ///< precision only
  bool has_obstacles() const { return !partial[0].empty(); }
};

/// Sets the conductances, for equal widths 1 on the finest grid.
/// @param conductance  per axis, D dt / h^2
template <class T>
void set_faces(const std::array<double, 3>& conductance, Level<T>& level);

/// Sets the conductances of faces that are partly open.
/// @param open  per axis across, [n_face] open fraction; those at the faces of the box count
/// nothing
template <class T>
void set_partial_faces(const std::array<double, 3>& conductance,
                       const std::array<std::vector<double>, 3>& open, Level<T>& level);

/// Sets the diagonal: the faces and `own`.
/// @param own  [n_voxel] what is on the diagonal besides faces
template <class T>
void set_diagonal(std::span<const double> own, Level<T>& level);

/// y = A x.   @return x . y, added plane by plane
double multiply(const Level<double>& level, const double* x, double* y);

/// Plane k of y = A x.   @return its part of x . y
double multiply_plane(const Level<double>& level, const double* x, double* y, int k);

/// Sweeps of red-black Gauss-Seidel. `forward`: first the even voxels, then the odd ones.
/// @param x  [size], changed; from_zero: overwritten
void smooth(const Level<float>& level, const float* b, float* x, bool forward, bool from_zero);

/// r = b - A x
template <class T>
void subtract_product(const Level<T>& level, const T* b, const T* x, T* r);

}  // namespace acinus::substances
