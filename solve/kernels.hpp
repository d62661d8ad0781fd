#pragma once
/// Lane kernels of the operator: one block of eight cells at a time, in double or in float.

#include "solve/link_kernels.hpp"
#include "solve/system.hpp"

namespace acinus::solve {

/// Largest number of rank-one families in a system: volume and area of cells and of nuclei use
/// four, devices one each.
inline constexpr std::size_t kMaxFamilies = 8;

/// Arrays and coefficients of one block, as the kernels read them.
struct BlockView {
  const BlockPattern* pattern;
  const double* medium;  ///< [n_point][lane]
  const float* shape;
  const float* spring;
  const float* edge;  ///< springs with merged contacts; null: use spring, contacts are apart
  const float* hinge;
  const float* face;
  const float* beam;
  double friction_scale;
  double dashpot;         ///< nN s/um
  double dashpot_across;  ///< ratio to that along the spring
  std::size_t n_family = 0;
  std::array<const float*, kMaxFamilies> vector{};        ///< [n_point][3][lane]
  std::array<const double*, kMaxFamilies> coefficient{};  ///< [lane]
};
/// View of one block of a system. @param edge  of MergedLinks, or null
BlockView view_block(const System& system, std::size_t block, const float* edge = nullptr);

/// Product y = A x of all elements within the cells, plus contact forces; returns x . y.
/// @param contact [n_point][lane] force of the contacts on each point
double multiply_block(const BlockView& block, const double* x, const Packed<double>* contact,
                      double* y);
double multiply_block(const BlockView& block, const float* x, const Packed<float>* contact,
                      float* y);

/// Friction part of the same product.
void multiply_friction(const BlockView& block, const double* x, const Packed<double>* contact,
                       double* y);

/// Adds the diagonal blocks of all elements within the cells except the rank-one terms.
/// @param diagonal [n_point][6][lane]
void add_diagonal(const BlockView& block, double* diagonal);

/// Inverse of the preconditioner of one block of the system, D^-1 - sum over families of u u^T: the
/// 3x3 diagonal blocks D of everything but the rank-one terms, plus those terms whole.
struct InverseView {
  int n_point = 0;
  const float* diagonal = nullptr;  ///< [n_point][6][lane]
  std::size_t n_family = 0;
  std::array<const float*, kMaxFamilies> vector{};  ///< u, [n_point][3][lane]
};

/// Next family's u after Sherman and Morrison (1950): M + c v v^T has the inverse M^-1 - u u^T, u =
/// sqrt(c / (1 + c w . v)) w with w = M^-1 v, here kRegularise less, so that the inverse stays
/// positive definite when u is rounded to float.
/// @param known  M^-1, with the families so far
void invert_rank_one(const InverseView& known, const float* vector, const double* coefficient,
                     float* u);

/// Relative stiffening of blocks before their inversion, in parts of the trace: the inverse stays
/// positive definite when it is rounded to float.
inline constexpr double kRegularise = 1e-6;
/// Inverts symmetric blocks lane by lane, each stiffened by kRegularise.
/// @param inverse [n_point][6][lane]
void invert_blocks(int n_point, const double* diagonal, float* inverse);

/// Preconditioner z = M^-1 r, unless z is null; returns r . M^-1 r.
double precondition_block(const InverseView& inverse, const double* r, double* z);
double precondition_block(const InverseView& inverse, const float* r, float* z);

/// Vectors of one iteration of conjugate gradients, one block.
template <class T>
struct DescentBlock {
  const T *p, *q;
  T *x, *r, *z;
};

/// Update x += alpha p, r -= alpha q, z = M^-1 r; returns r . z.
double descend_block(const InverseView& inverse, double alpha, const DescentBlock<double>& v);
double descend_block(const InverseView& inverse, double alpha, const DescentBlock<float>& v);

/// Dot product; n is a multiple of kLanes.
double dot_range(const double* a, const double* b, std::size_t n);
double dot_range(const float* a, const float* b, std::size_t n);

/// New direction p = z + beta p.
void redirect_range(const double* z, double beta, double* p, std::size_t n);
void redirect_range(const float* z, double beta, float* p, std::size_t n);

}  // namespace acinus::solve
