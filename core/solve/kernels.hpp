#pragma once
/// Lane kernels of the operator: one block of eight cells at a time, in double or in float.

#include "core/solve/link_kernels.hpp"
#include "core/solve/system.hpp"

namespace acinus::solve {

/// Most rank-one families a system may have (volume and area use two).
inline constexpr std::size_t kMaxFamilies = 4;

/// What the kernels read of one block.
struct BlockView {
  const BlockPattern* pattern;
  const double* medium;  ///< [n_point][lane]
  const float* spring;
  const float* edge;  ///< springs with merged contacts; null: spring, and no contacts
  const float* hinge;
  const float* face;
  double friction_scale;
  std::size_t n_family = 0;
  std::array<const double*, kMaxFamilies> vector{};       ///< [n_point][3][lane]
  std::array<const double*, kMaxFamilies> coefficient{};  ///< [lane]
};
/// @param edge  of MergedLinks, or null
BlockView view_block(const System& system, std::size_t block, const float* edge = nullptr);

/// y = A x of everything within the cells, plus what contacts add; returns x . y.
/// @param contact [n_point][lane] force of the contacts on each point
double multiply_block(const BlockView& block, const double* x, const Packed<double>* contact,
                      double* y);
double multiply_block(const BlockView& block, const float* x, const Packed<float>* contact,
                      float* y);

/// Adds the diagonal blocks of everything within the cells.
/// @param diagonal [n_point][6][lane]
void add_diagonal(const BlockView& block, double* diagonal);

/// Inverts symmetric blocks lane by lane, each made a little stiffer first (kRegularise of its
/// trace), so that the inverse stays positive definite when it is rounded to float.
inline constexpr double kRegularise = 1e-6;
/// @param inverse [n_point][6][lane]
void invert_blocks(int n_point, const double* diagonal, float* inverse);

/// z = D^-1 r, unless z is null; returns r . D^-1 r.
double precondition_block(int n_point, const float* inverse, const double* r, double* z);
double precondition_block(int n_point, const float* inverse, const float* r, float* z);

/// x += alpha p, r -= alpha q, z = D^-1 r; returns r . z.
double descend_block(int n_point, double alpha, const float* inverse, const double* p,
                     const double* q, double* x, double* r, double* z);
double descend_block(int n_point, double alpha, const float* inverse, const float* p,
                     const float* q, float* x, float* r, float* z);

/// Sum of products; n is a multiple of kLanes.
double dot_range(const double* a, const double* b, std::size_t n);
double dot_range(const float* a, const float* b, std::size_t n);

/// p = z + beta p.
void redirect_range(const double* z, double beta, double* p, std::size_t n);
void redirect_range(const float* z, double beta, float* p, std::size_t n);

}  // namespace acinus::solve
