#pragma once
/// Grids, media and exact fields shared by the tests of substances.

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "substances/diffusion.hpp"

namespace acinus::substances {

/// Tolerance of the solver where another error is measured.
inline constexpr double kTight = 1e-12;
/// A step so long that only the steady state is left, s.
inline constexpr double kSteady = 1e12;

/// Bodies that exchange nothing.
inline const Shares kNoShares{};
inline ExchangingBodies no_bodies() { return {kNoShares, {}}; }

inline VoxelGrid cube(double edge, int n) {
  return make_grid({Vec3::Zero(), Vec3::Constant(edge)}, edge / n * (1 + 1e-12));
}

/// Closed surface of a box, faces outward.
struct BoxMesh {
  std::vector<Vec3> node;
  std::vector<std::array<int, 3>> triangle{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                           {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                           {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
};
inline BoxMesh box_mesh(const Vec3& low, const Vec3& high) {
  BoxMesh box;
  for (int k = 0; k < 8; ++k)
    box.node.emplace_back((k & 1 ? high : low).x(), (k & 2 ? high : low).y(),
                          (k & 4 ? high : low).z());
  return box;
}

inline std::vector<double> sample(const VoxelGrid& g, const std::function<double(const Vec3&)>& f) {
  std::vector<double> c;
  for (int k = 0; k < g.n[2]; ++k)
    for (int j = 0; j < g.n[1]; ++j)
      for (int i = 0; i < g.n[0]; ++i) c.push_back(f(g.center(i, j, k)));
  return c;
}

/// Largest difference from an exact field where `counts` is true.
inline double largest_error(
    const VoxelGrid& g, std::span<const double> c, const std::function<double(const Vec3&)>& exact,
    const std::function<bool(const Vec3&)>& counts = [](const Vec3&) { return true; }) {
  double largest = 0;
  std::size_t v = 0;
  for (int k = 0; k < g.n[2]; ++k)
    for (int j = 0; j < g.n[1]; ++j)
      for (int i = 0; i < g.n[0]; ++i, ++v)
        if (const Vec3 x = g.center(i, j, k); counts(x))
          largest = std::max(largest, std::abs(c[v] - exact(x)));
  return largest;
}

/// Root mean square difference from an exact field where `counts` is true.
inline double mean_error(const VoxelGrid& g, std::span<const double> c,
                         const std::function<double(const Vec3&)>& exact,
                         const std::function<bool(const Vec3&)>& counts) {
  double sum = 0, n = 0;
  std::size_t v = 0;
  for (int k = 0; k < g.n[2]; ++k)
    for (int j = 0; j < g.n[1]; ++j)
      for (int i = 0; i < g.n[0]; ++i, ++v)
        if (const Vec3 x = g.center(i, j, k); counts(x)) {
          sum += (c[v] - exact(x)) * (c[v] - exact(x));
          n += 1;
        }
  return std::sqrt(sum / n);
}

inline Budget run(const VoxelGrid& g, const Medium& m, const ExchangingBodies& bodies,
                  const Advance& how, std::vector<double>& c, std::span<double> gained = {}) {
  Solver solver;
  solver.resize(g.n);
  return advance(g, m, bodies, how, solver, c, gained);
}

}  // namespace acinus::substances
