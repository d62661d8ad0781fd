#pragma once
/// Work and sums over the planes of a grid, shared among threads. Sums are added plane by plane,
/// so they have the same bits for any number of threads.

#include <cstddef>
#include <span>
#include <vector>

#include "core/parallel/threads.hpp"

namespace acinus::substances {

/// Number of voxels below which threads cost more than they save.
inline constexpr std::size_t kParallelVoxels = 20000;

template <class F>
void for_each_plane(int n_plane, std::size_t n_voxel, const F& f) {
  for_each_index(static_cast<std::size_t>(n_plane), n_voxel > kParallelVoxels,
                 [&](std::size_t k) { f(static_cast<int>(k)); });
}

/// Sum of f(plane).
template <class F>
double sum_planes(int n_plane, std::size_t n_voxel, const F& f) {
  std::vector<double> part(static_cast<std::size_t>(n_plane));
  for_each_plane(n_plane, n_voxel, [&](int k) { part[static_cast<std::size_t>(k)] = f(k); });
  double sum = 0;
  for (const double p : part) sum += p;
  return sum;
}

/// Sum of the numbers, and of the products of two arrays, in lanes of a fixed order.
double sum_numbers(std::span<const double> a);
double dot_numbers(std::span<const double> a, std::span<const double> b);

/// The same of arrays over all voxels, plane by plane.   @param n_plane  planes of equal size
inline double sum_voxels(int n_plane, std::span<const double> a) {
  const std::size_t n = a.size() / static_cast<std::size_t>(n_plane);
  return sum_planes(n_plane, a.size(), [&](int k) { return sum_numbers(a.subspan(k * n, n)); });
}
inline double dot_voxels(int n_plane, std::span<const double> a, std::span<const double> b) {
  const std::size_t n = a.size() / static_cast<std::size_t>(n_plane);
  return sum_planes(n_plane, a.size(),
                    [&](int k) { return dot_numbers(a.subspan(k * n, n), b.subspan(k * n, n)); });
}

}  // namespace acinus::substances
