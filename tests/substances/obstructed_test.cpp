/// Diffusion around obstacles: effective diffusion of arrays of spheres, order, balance, bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/numbers/random.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "geometry/topology.hpp"
#include "substances/diffusion.hpp"
#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

OpenSpace space_outside(const VoxelGrid& g, const std::vector<Cover>& covers) {
  CoveredSpace covered(g);
  for (const Cover& c : covers) covered.add(c);
  return covered.open(g);
}

/// Flux per area and gradient through a cell of a cubic array, relative to D.
double effective_diffusion(const VoxelGrid& g, const Cover& sphere) {
  const OpenSpace space = space_outside(g, {sphere});
  Medium m;
  m.diffusion = 1;
  m.face[0] = {FaceKind::kFixed, 1, 0};
  m.face[1] = {FaceKind::kFixed, 0, 0};
  std::vector<double> c(g.n_voxel(), 0.5);
  Advance how{.step = kSteady, .tolerance = kTight};
  how.space = &space;
  run(g, m, no_bodies(), how, c);
  double flux = 0;
  const double h = g.spacing.x();
  for (int k = 0; k < g.n[2]; ++k)
    for (int j = 0; j < g.n[1]; ++j)
      flux += (1 - c[g.index(0, j, k)]) / (0.5 * h) * space.face[0][g.face_index(0, 0, j, k)];
  return flux / g.n[1] / g.n[2];
}

/// Insulating spheres in a simple cubic array. Exact: expansion in harmonics of odd degree up to 31
/// fitted to the faces of the cell; at a volume fraction of 0.5 also the limit of fine grids.
/// Maxwell's formula 2 (1 - phi) / (2 + phi) is 0.003, 0.5 and 7 % above it.
struct Array {
  double fraction, exact;
  double radius() const { return std::cbrt(3 * fraction / (4 * kPi)); }
  double maxwell() const { return 2 * (1 - fraction) / (2 + fraction); }
};
constexpr std::array<Array, 3> kArrays{{{0.1, 0.85711}, {0.3, 0.60566}, {0.5, 0.3737}}};

TEST(Obstructed, ArraysOfSpheresHaveTheirEffectiveDiffusion) {
  for (const Array& a : kArrays)
    for (const int n : {3, 5, 8, 10, 20}) {
      const VoxelGrid g = cube(1, n);
      const double d = effective_diffusion(g, cover_sphere(g, Vec3::Constant(0.5), a.radius()));
      std::printf(
          "fraction %.1f, %2d voxels (R = %.1f h): %.5f, %+.2f %% of exact, %+.2f %% of "
          "Maxwell's\n",
          a.fraction, n, a.radius() * n, d, 100 * (d / a.exact - 1), 100 * (d / a.maxwell() - 1));
      if (n < 8) continue;
      EXPECT_NEAR(d, a.exact, 0.01 * a.exact);
      if (a.fraction < 0.4) {
        EXPECT_NEAR(d, a.maxwell(), 0.02 * a.maxwell());
      }
    }
}

TEST(Obstructed, MeshesObstructLikeTheirSpheres) {
  const geometry::Topology& t = geometry::shared_icosphere(642);
  for (const Array& a : kArrays) {
    const VoxelGrid g = cube(1, 10);
    double volume = 0;
    for (const auto& [i, j, k] : t.triangle)
      volume += t.rest[i].dot(t.rest[j].cross(t.rest[k])) / 6;
    std::vector<Vec3> node;
    const double radius = std::cbrt(a.fraction / volume);  // of a mesh with the sphere's volume
    for (const Vec3& x : t.rest) node.push_back(Vec3::Constant(0.5) + radius * x);
    const double d = effective_diffusion(g, cover_surface(g, node, t.triangle));
    std::printf("fraction %.1f, mesh: %+.2f %%\n", a.fraction, 100 * (d / a.exact - 1));
    EXPECT_NEAR(d, a.exact, 0.02 * a.exact);
  }
}

/// Error near an insulating sphere in a gradient: c = x (1 + R^3 / 2 r^3) + 2, held beyond 1.6 R.
double sphere_error(int n) {
  const double radius = 50, half = 100;
  const auto exact = [=](const Vec3& x) {
    const double r = std::max(x.norm(), radius);
    return 200 + x.x() * (1 + std::pow(radius / r, 3) / 2);
  };
  const VoxelGrid g =
      make_grid({Vec3::Constant(-half), Vec3::Constant(half)}, 2 * half / n * (1 + 1e-12));
  const OpenSpace space = space_outside(g, {cover_sphere(g, Vec3(1.3, -2.1, 0.7), radius)});
  Medium m;
  m.diffusion = 10;
  constexpr double kHold = 1e6;  // 1/s
  m.gain.assign(g.n_voxel(), 0.0);
  m.loss.assign(g.n_voxel(), 0.0);
  const auto centred = [&](const Vec3& x) { return exact(x - Vec3(1.3, -2.1, 0.7)); };
  std::size_t v = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i, ++v)
        if (const Vec3 x = g.center(i, j, k); x.norm() > 1.6 * radius) {
          m.loss[v] = kHold;
          m.gain[v] = kHold * centred(x);
        }
  std::vector<double> c(g.n_voxel(), 0.0);
  Advance how{.step = kSteady, .tolerance = kTight};
  how.space = &space;
  run(g, m, no_bodies(), how, c);
  return mean_error(g, c, centred, [&](const Vec3& x) {
    const double r = (x - Vec3(1.3, -2.1, 0.7)).norm();
    return r > radius && r < 1.5 * radius;
  });
}

TEST(Obstructed, IsOfSecondOrderAroundASphere) {
  const double coarse = sphere_error(24), middle = sphere_error(48), fine = sphere_error(96);
  std::printf("errors %.3f, %.3f, %.3f: orders %.2f, %.2f\n", coarse, middle, fine,
              std::log2(coarse / middle), std::log2(middle / fine));
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.5);
  EXPECT_LT(fine, 0.001 * 75);  // of c - 200 at the poles
}

/// Spheres at random places, some of which overlap.
std::vector<Cover> random_spheres(const VoxelGrid& g, int n, double radius, double shift) {
  std::vector<Cover> covers;
  const auto number = [](int k, std::uint32_t c) {
    return uniform({3, Purpose::kTest, static_cast<std::uint64_t>(k), 0, c});
  };
  const Vec3 size = g.high() - g.low;
  for (int k = 0; k < n; ++k) {
    Vec3 x = g.low + size.cwiseProduct(Vec3(number(k, 0), number(k, 1), number(k, 2)));
    x += shift * Vec3(number(k, 3) - 0.5, number(k, 4) - 0.5, number(k, 5) - 0.5);
    covers.push_back(cover_sphere(g, x, radius));
  }
  return covers;
}

TEST(Obstructed, MovingBodiesKeepAmountsAndSigns) {
  const VoxelGrid g = make_grid({Vec3(-3, 2, 7), Vec3(90, 110, 80)}, 5.3);
  Medium m;
  m.diffusion = 20;
  m.decay = 0.01;
  m.face[0] = {FaceKind::kFixed, 3, 0};
  m.face[5] = {FaceKind::kExchange, 1, 0.5};
  m.gain.assign(g.n_voxel(), 0.001);
  m.loss.assign(g.n_voxel(), 0.002);
  m.wall_gain.assign(g.n_voxel(), 0.002);
  m.wall_loss.assign(g.n_voxel(), 0.001);
  Shares all;
  all.add(share_sphere_by_area(g, Vec3(40, 50, 40), 12));
  Exchange e;
  e.uptake_max = 0.3;
  e.half_max = 2;
  std::vector<double> c(g.n_voxel(), 2.0), held, open;
  double before = 0, imbalance = 0;
  for (int step = 0; step <= 8; ++step) {
    const OpenSpace space = space_outside(g, random_spheres(g, 120, 9, 6.0 * step));
    if (step > 0) {
      held.resize(c.size());
      for (std::size_t v = 0; v < c.size(); ++v) held[v] = open[v] * c[v];
      carry_amounts(space, held);
      Shares shares = all;
      for (VoxelShare& s : shares.share) s.voxel = space.nearest[s.voxel];
      std::vector<double> gained(1, 0.0);
      Advance how{.step = 30, .longest = 10, .tolerance = 1e-4};
      how.space = &space;
      how.held = held;
      const Budget b = run(g, m, {shares, {&e, 1}}, how, c, gained);
      fill_closed(g, space, c);
      const double now = total_amount(g, c, space.volume);
      const double sum = b.secreted + b.entered + b.supplied - b.decayed;
      const double size = std::abs(b.entered) + std::abs(b.supplied) + b.decayed + now;
      imbalance = std::max(
          {imbalance, std::abs(b.change - sum) / size, std::abs(now - before - sum) / size});
      EXPECT_TRUE(b.converged);
      EXPECT_NEAR(gained[0], b.secreted, 1e-12 * size);
      EXPECT_GT(std::ranges::min(c), 0);
    }
    open = space.volume;
    before = total_amount(g, c, open);
  }
  std::printf("imbalance %.2e\n", imbalance);
  EXPECT_LT(imbalance, 1e-12);
}

TEST(Obstructed, UniformFieldsStayUniform) {
  const VoxelGrid g = cube(100, 20);
  const OpenSpace space = space_outside(g, random_spheres(g, 100, 9, 0));
  Medium m;
  m.diffusion = 50;
  m.face.fill({FaceKind::kFixed, 4, 0});
  std::vector<double> c(g.n_voxel(), 4.0);
  Advance how{.step = 600, .tolerance = kTight};
  how.space = &space;
  run(g, m, no_bodies(), how, c);
  for (const double value : c) EXPECT_NEAR(value, 4, 1e-9);
}

TEST(Obstructed, SolverConvergesInDenseTissue) {
  // Many closed pockets, and others behind narrow openings.
  const VoxelGrid g = cube(300, 48);
  for (const int n : {300, 1200, 3000}) {
    const OpenSpace space = space_outside(g, random_spheres(g, n, 13, 0));
    double open = 0;
    for (const double x : space.volume) open += x / static_cast<double>(g.n_voxel());
    Medium m;
    m.diffusion = 1;
    m.face[0] = {FaceKind::kFixed, 3, 0};
    for (const double step : {4.0, 4e2, 4e4, 4e6}) {
      std::vector<double> c(g.n_voxel(), 0.0);
      Advance how{.step = step, .tolerance = 1e-8};
      how.space = &space;
      const Budget b = run(g, m, no_bodies(), how, c);
      std::printf("open %.2f, D dt / h^2 = %.1e: %d iterations\n", open,
                  step / g.spacing.x() / g.spacing.x(), static_cast<int>(b.iterations));
      EXPECT_TRUE(b.converged);
      EXPECT_LE(b.iterations, 45);
    }
  }
}

TEST(Obstructed, HasTheSameBitsWithMoreThreads) {
  const VoxelGrid g = cube(300, 37);  // more voxels than threads are worth
  const OpenSpace space = space_outside(g, random_spheres(g, 400, 20, 0));
  Medium m;
  m.diffusion = 200;
  m.face.fill({FaceKind::kFixed, 2, 0});
  const auto result = [&](int n) {
    set_threads(n);
    std::vector<double> c = sample(g, [](const Vec3& x) { return 1 + std::cos(0.03 * x.sum()); });
    Advance how{.step = 60, .tolerance = 1e-7};
    how.space = &space;
    run(g, m, no_bodies(), how, c);
    fill_closed(g, space, c);
    set_threads(1);
    return c;
  };
  const std::vector<double> one = result(1);
  EXPECT_EQ(one, result(2));
  EXPECT_EQ(one, result(3));
}

}  // namespace
}  // namespace acinus::substances
