#include "substances/solve.hpp"

#include <algorithm>
#include <cmath>

#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

constexpr int kMostIterations = 200;

template <class T>
ACINUS_INLINE double dot_row_of(std::size_t n, const double* a, const T* b) {
  Lane sum = lane_of(0);
  for (std::size_t i = 0; i < n; i += kLanes) sum += load(a + i) * load<double>(b + i);
  return sum_lanes<double>(sum);
}
ACINUS_KERNEL double dot_row(std::size_t n, const double* a, const float* b) {
  return dot_row_of(n, a, b);
}
ACINUS_KERNEL double dot_row(std::size_t n, const double* a, const double* b) {
  return dot_row_of(n, a, b);
}

/// x = factor x, r = b - A x after it
ACINUS_KERNEL void scale_row(std::size_t n, double factor, const double* b, double* x, double* r) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    store(x + i, factor * load(x + i));
    store(r + i, factor * load(r + i) + (1 - factor) * load(b + i));
  }
}

/// p = z + beta p
ACINUS_KERNEL void turn_row(std::size_t n, double beta, const float* z, double* p) {
  for (std::size_t i = 0; i < n; i += kLanes)
    store(p + i, load<double>(z + i) + beta * load(p + i));
}

/// x += alpha p, r -= alpha q, rf = scale r.   @return r . r
ACINUS_KERNEL double advance_row(std::size_t n, double alpha, double scale, const double* p,
                                 const double* q, double* x, double* r, float* rf) {
  Lane sum = lane_of(0);
  for (std::size_t i = 0; i < n; i += kLanes) {
    store(x + i, load(x + i) + alpha * load(p + i));
    const Lane value = load(r + i) - alpha * load(q + i);
    store(r + i, value);
    store(rf + i, scale * value);
    sum += value * value;
  }
  return sum_lanes<double>(sum);
}

/// Numbers of plane k, its padding included: first and count, in whole lanes.
struct PlaneRange {
  std::size_t first, n;
};
PlaneRange plane_of(const PaddedLayout& l, int k) {
  return {l.row(0, k), static_cast<std::size_t>(l.n[1]) * l.stride};
}

/// p = z + beta p, q = A p.   @return p . q, added plane by plane
double turn_and_multiply(const Level<double>& level, double beta, const float* z, double* p,
                         double* q) {
  const PaddedLayout& l = level.layout;
  const auto turn = [&](int k) {
    const auto [first, n] = plane_of(l, k);
    turn_row(n, beta, z + first, p + first);
  };
  if (thread_count() > 1 && l.n_voxel() > kParallelVoxels) {
    for_each_plane(l.n[2], l.n_voxel(), turn);
    return multiply(level, p, q);
  }
  // The product follows one plane behind, while its neighbours are in the cache.
  double sum = 0;
  turn(0);
  for (int k = 0; k < l.n[2]; ++k) {
    if (k + 1 < l.n[2]) turn(k + 1);
    sum += multiply_plane(level, p, q, k);
  }
  return sum;
}

/// Copies voxels into padded rows or back, calling f(padded place, voxel).
template <class F>
void for_each_voxel(const PaddedLayout& l, const F& f) {
  for_each_plane(l.n[2], l.n_voxel(), [&](int k) {
    std::size_t voxel = static_cast<std::size_t>(k) * l.n[1] * l.n[0];
    for (int j = 0; j < l.n[1]; ++j) {
      const std::size_t row = l.row(j, k);
      for (int i = 0; i < l.n[0]; ++i) f(row + i, voxel++);
    }
  });
}

}  // namespace

void Solver::resize(const std::array<int, 3>& n) {
  level_ = {};
  level_.layout = make_layout(n);
  for (int axis = 0; axis < 3; ++axis) level_.width[axis].assign(n[axis], 1.0);
  multigrid_.resize(n);
  const std::size_t size = level_.layout.size;
  for (std::vector<double>* v : {&x_, &r_, &p_, &q_}) v->assign(size, 0.0);
  rf_.assign(size, 0.0F);
  z_.assign(size, 0.0F);
}

void Solver::scale_start() {
  const PaddedLayout& l = level_.layout;
  const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return sum_planes(l.n[2], l.n_voxel(), [&](int k) {
      const auto [first, n] = plane_of(l, k);
      return dot_row(n, a.data() + first, b.data() + first);
    });
  };
  const double xb = product(x_, q_), xr = product(x_, r_);
  if (!(xb > 0) || !(xb > xr)) return;
  const double factor = xb / (xb - xr);
  for_each_plane(l.n[2], l.n_voxel(), [&](int k) {
    const auto [first, n] = plane_of(l, k);
    scale_row(n, factor, q_.data() + first, x_.data() + first, r_.data() + first);
  });
}

SolveResult Solver::solve(const StepSystem& system, double tolerance, std::span<double> c) {
  const PaddedLayout& l = level_.layout;
  set_faces(system.conductance, level_);
  if (system.open != nullptr) set_partial_faces(system.conductance, *system.open, level_);
  set_diagonal<double>(system.own, level_);
  multigrid_.set(system.own, system.conductance, system.open);

  for_each_voxel(l, [&](std::size_t at, std::size_t voxel) {
    x_[at] = c[voxel];
    q_[at] = system.rhs[voxel];
  });
  const double norm = std::sqrt(dot_voxels(l.n[2], system.rhs, system.rhs));
  SolveResult result;
  if (!(norm > 0)) {
    std::ranges::fill(c, 0.0);
    result.converged = true;
    return result;
  }
  const double scale = 1 / norm;
  const auto norm_of = [](double rr) { return std::sqrt(std::max(rr, 0.0)); };
  subtract_product(level_, q_.data(), x_.data(), r_.data());
  scale_start();
  double rr = sum_planes(l.n[2], l.n_voxel(), [&](int k) {
    const auto [first, n] = plane_of(l, k);
    return advance_row(n, 0, scale, p_.data() + first, q_.data() + first, x_.data() + first,
                       r_.data() + first, rf_.data() + first);
  });
  double rz_before = 0;
  while (norm_of(rr) > tolerance * norm && result.iterations < kMostIterations) {
    multigrid_.apply(rf_.data(), z_.data());
    const double rz = sum_planes(l.n[2], l.n_voxel(), [&](int k) {
      const auto [first, n] = plane_of(l, k);
      return dot_row(n, r_.data() + first, z_.data() + first);
    });
    const double beta = result.iterations == 0 ? 0 : rz / rz_before;
    rz_before = rz;
    const double pq = turn_and_multiply(level_, beta, z_.data(), p_.data(), q_.data());
    if (!(pq > 0)) break;
    const double alpha = rz / pq;
    rr = sum_planes(l.n[2], l.n_voxel(), [&](int k) {
      const auto [first, n] = plane_of(l, k);
      return advance_row(n, alpha, scale, p_.data() + first, q_.data() + first, x_.data() + first,
                         r_.data() + first, rf_.data() + first);
    });
    ++result.iterations;
  }
  result.residual = norm_of(rr) / norm;
  result.converged = result.residual <= tolerance;

  // No concentration is below 0: what the tolerance leaves there is cut before amounts are
  // balanced.
  for_each_voxel(l, [&](std::size_t at, std::size_t voxel) { c[voxel] = std::max(x_[at], 0.0); });
  // Faces cancel in the sum of A c.
  const double held = dot_voxels(l.n[2], system.own, c);
  const double wanted = sum_voxels(l.n[2], system.rhs);
  const double factor = wanted / held;
  if (factor > 0.5 && factor < 2) {
    for (double& value : c) value *= factor;
  }
  return result;
}

}  // namespace acinus::substances
