/// Substances inside and outside bodies, behind membranes: equilibration, spheres in a gradient,
/// limits of permeability, balance, bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/numbers/random.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "geometry/topology.hpp"
#include "substances/diffusion.hpp"
#include "tests/substances/fields.hpp"

namespace acinus::substances {
namespace {

/// Spheres with membranes in a box.
struct Spheres {
  VoxelGrid grid;
  OpenSpace space;
  Parts parts;

  Spheres(const VoxelGrid& g, const std::vector<Vec3>& center, double radius) : grid(g) {
    CoveredSpace covered(g);
    for (const Vec3& x : center) {
      const Cover cover = cover_sphere(g, x, radius);
      covered.add(cover);
      add_body(g, cover, share_sphere_by_area(g, x, radius), 4 * kPi * radius * radius, parts);
    }
    space = covered.open(g);
  }
  std::size_t n() const { return grid.n_voxel() + parts.n(); }
  Advance how(double step, double permeability) const {
    Advance h{.step = step, .tolerance = kTight};
    h.space = &space;
    h.parts = &parts;
    h.permeability = permeability;
    return h;
  }
  std::span<const double> inside(const std::vector<double>& c) const {
    return std::span(c).subspan(grid.n_voxel());
  }
  double mean_inside(const std::vector<double>& c) const {
    double sum = 0, volume = 0;
    for (std::size_t p = 0; p < parts.n(); ++p) {
      sum += parts.volume[p] * inside(c)[p];
      volume += parts.volume[p];
    }
    return sum / volume;
  }
};

std::vector<Vec3> random_places(const VoxelGrid& g, int n) {
  std::vector<Vec3> place;
  const auto number = [](int k, std::uint32_t c) {
    return uniform({5, Purpose::kTest, static_cast<std::uint64_t>(k), 0, c});
  };
  for (int k = 0; k < n; ++k)
    place.push_back(
        g.low + (g.high() - g.low).cwiseProduct(Vec3(number(k, 0), number(k, 1), number(k, 2))));
  return place;
}

TEST(Membrane, SphereFillsAtTheRateOfItsAreaOverItsVolume) {
  constexpr double kRadius = 10, kPermeability = 0.01, kStep = 1, kEdge = 60;
  for (const int n : {12, 24}) {
    const VoxelGrid g = cube(kEdge, n);
    const Spheres s(g, {Vec3(30.7, 29.2, 30.1)}, kRadius);
    Medium m;
    m.diffusion = 1e4;
    m.face.fill({FaceKind::kFixed, 1, 0});
    std::vector<double> c(s.n(), 1.0);
    std::fill(c.begin() + static_cast<std::ptrdiff_t>(g.n_voxel()), c.end(), 0.0);
    constexpr int kSteps = 200;
    for (int k = 0; k < kSteps; ++k) run(g, m, no_bodies(), s.how(kStep, kPermeability), c);
    const double rate = -std::log(1 - s.mean_inside(c)) / (kSteps * kStep),
                 exact = kPermeability * 3 / kRadius;
    std::printf("R = %.0f h: rate %+.2f %% of P S / V\n", kRadius / g.spacing.x(),
                100 * (rate / exact - 1));
    EXPECT_NEAR(rate, exact, 0.02 * exact);
    const auto [low, high] = std::ranges::minmax(s.inside(c));
    EXPECT_LT(high - low, 1e-3);
  }
}

/// Effective diffusion of a cubic array of spheres of an edge 1, relative to D.
double effective_diffusion(int n, double fraction, double permeability) {
  const VoxelGrid g = cube(1, n);
  const Spheres s(g, {Vec3::Constant(0.5)}, std::cbrt(3 * fraction / (4 * kPi)));
  Medium m;
  m.diffusion = 1;
  m.face[0] = {FaceKind::kFixed, 1, 0};
  m.face[1] = {FaceKind::kFixed, 0, 0};
  std::vector<double> c(s.n(), 0.5);
  Advance how = s.how(kSteady, permeability);
  if (permeability == 0) {
    how.parts = nullptr;
    c.resize(g.n_voxel());
  }
  EXPECT_TRUE(run(g, m, no_bodies(), how, c).converged);
  double flux = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) flux += (1 - c[g.index(0, j, k)]) / (0.5 * g.spacing.x());
  return flux / n / n;
}

/// A sphere with a membrane acts outside like one that conducts D / (1 + D / (P R)).
TEST(Membrane, ArraysOfSpheresFollowMaxwellWithAnInterface) {
  for (const double fraction : {0.1, 0.2})
    for (const double biot : {0.3, 1.0, 3.0, 10.0})
      for (const int n : {8, 10, 20}) {
        const double radius = std::cbrt(3 * fraction / (4 * kPi)), inner = 1 / (1 + 1 / biot);
        const double exact =
            (2 + inner - 2 * fraction * (1 - inner)) / (2 + inner + fraction * (1 - inner));
        const double d = effective_diffusion(n, fraction, biot / radius);
        std::printf("fraction %.1f, P R / D = %4.1f, R = %.1f h: %.5f, %+.2f %%\n", fraction, biot,
                    radius * n, d, 100 * (d / exact - 1));
        EXPECT_NEAR(d, exact, 0.01 * exact);
      }
}

TEST(Membrane, LimitsAreObstructedAndFreeDiffusion) {
  const double closed = effective_diffusion(10, 0.3, 0);
  EXPECT_NEAR(effective_diffusion(10, 0.3, 1e-9), closed, 1e-6);
  EXPECT_NEAR(effective_diffusion(10, 0.3, 1e6), 1, 1e-3);
  // Over time too: a profile that spreads through spheres as if there were none.
  const VoxelGrid g = cube(100, 25);
  const Spheres s(g, {Vec3(30, 40, 50), Vec3(70, 55, 45), Vec3(52, 80, 22)}, 17);
  Medium m;
  m.diffusion = 10;
  m.face[0] = {FaceKind::kFixed, 1, 0};
  std::vector<double> free(g.n_voxel(), 0.0), c(s.n(), 0.0);
  for (int k = 0; k < 5; ++k) {
    run(g, m, no_bodies(), {.step = 20, .tolerance = kTight}, free);
    EXPECT_TRUE(run(g, m, no_bodies(), s.how(20, 1e4), c).converged);
  }
  // Means of voxels: a sliver of a cell without a point of its surface has its neighbour's value.
  std::vector<double> amount(g.n_voxel()), filled = s.space.volume;
  for (std::size_t v = 0; v < g.n_voxel(); ++v) amount[v] = s.space.volume[v] * c[v];
  for (std::size_t p = 0; p < s.parts.n(); ++p) {
    amount[s.parts.voxel[p]] += s.parts.volume[p] / g.voxel_volume() * s.inside(c)[p];
    filled[s.parts.voxel[p]] += s.parts.volume[p] / g.voxel_volume();
  }
  double largest = 0;
  for (std::size_t v = 0; v < g.n_voxel(); ++v)
    largest = std::max(largest, std::abs(amount[v] / filled[v] - free[v]));
  std::printf("largest difference from free diffusion %.1e\n", largest);
  EXPECT_LT(largest, 5e-3);
}

/// Neighbours whose surfaces touch exchange through two membranes, never directly.
TEST(Membrane, CellsThatTouchStayApart) {
  const VoxelGrid g = cube(60, 15);
  const Spheres s(g, {Vec3(20.3, 30, 30), Vec3(40.2, 30, 30)}, 10);
  Medium m;
  m.diffusion = 100;
  std::vector<double> c(s.n(), 0.0);
  for (std::size_t p = s.parts.start[0]; p < s.parts.start[1]; ++p) c[g.n_voxel() + p] = 1;
  const std::vector<double> start = c;
  run(g, m, no_bodies(), s.how(1e6, 1e-12), c);
  for (std::size_t k = g.n_voxel(); k < c.size(); ++k) EXPECT_NEAR(c[k], start[k], 1e-5);
}

Shares shares_of_parts(const Spheres& s) {
  Shares shares;
  for (std::size_t b = 0; b < s.parts.n_body(); ++b) {
    std::vector<VoxelShare> of;
    for (std::size_t p = s.parts.start[b]; p < s.parts.start[b + 1]; ++p)
      of.push_back({s.grid.n_voxel() + p, s.parts.volume[p]});
    shares.add(of);
  }
  return shares;
}

TEST(Membrane, AmountsBalanceAndStayPositive) {
  const VoxelGrid g = cube(200, 20);
  for (const double permeability : {1e-3, 1.0, 1e3}) {
    const Spheres s(g, random_places(g, 150), 15);  // many overlap
    const Shares shares = shares_of_parts(s);
    std::vector<Exchange> exchange(s.parts.n_body());
    for (std::size_t b = 0; b < exchange.size(); ++b) {
      exchange[b].uptake_max = b % 3 == 0 ? 0.5 : 0;
      exchange[b].secretion = b % 3 == 1 ? 0.2 : 0;
    }
    Medium m;
    m.diffusion = 50;
    m.decay = 1e-3;
    m.face[2] = {FaceKind::kFixed, 5, 0};
    m.face[5] = {FaceKind::kExchange, 2, 0.3};
    std::vector<double> c(s.n(), 1.0), gained(s.parts.n_body(), 0.0);
    Advance how = s.how(60, permeability);
    how.tolerance = 1e-6;
    how.longest = 20;
    const Budget b = run(g, m, {shares, exchange}, how, c, gained);
    const double sum = b.secreted + b.entered + b.supplied - b.decayed,
                 size = std::abs(b.secreted) + std::abs(b.entered) + b.decayed;
    std::printf("P = %g: imbalance %.1e, %ld iterations in %ld solves\n", permeability,
                std::abs(b.change - sum) / size, static_cast<long>(b.iterations),
                static_cast<long>(b.solves));
    EXPECT_TRUE(b.converged);
    EXPECT_LT(std::abs(b.change - sum), 1e-12 * size);
    for (std::size_t p = 0; p < s.parts.n(); ++p) EXPECT_GT(s.inside(c)[p], 0);
    for (std::size_t v = 0; v < g.n_voxel(); ++v)
      if (s.space.volume[v] > 0) {
        EXPECT_GT(c[v], 0);
      }
  }
}

TEST(Membrane, HasTheSameBitsWithMoreThreads) {
  const VoxelGrid g = cube(300, 30);
  const Spheres s(g, random_places(g, 200), 15);
  Medium m;
  m.diffusion = 50;
  m.face[0] = {FaceKind::kFixed, 5, 0};
  const auto result = [&](int threads) {
    set_threads(threads);
    std::vector<double> c(s.n(), 1.0);
    run(g, m, no_bodies(), s.how(60, 0.5), c);
    set_threads(1);
    return c;
  };
  const std::vector<double> one = result(1);
  EXPECT_EQ(one, result(2));
  EXPECT_EQ(one, result(3));
}

TEST(Parts, OfAMeshFillItAndItsMembraneHasItsArea) {
  const geometry::Topology& t = geometry::shared_icosphere(642);
  const VoxelGrid g = cube(60, 12);
  std::vector<Vec3> node;
  for (const Vec3& x : t.rest) node.push_back(Vec3(31, 28, 30) + 14 * x);
  Parts parts;
  constexpr double kArea = 4 * kPi * 14 * 14;
  add_body(g, cover_surface(g, node, t.triangle), share_surface_by_area(g, node, t.triangle), kArea,
           parts);
  double volume = 0, area = 0;
  for (const double v : parts.volume) volume += v;
  for (const Parts::Membrane& wall : parts.membrane) area += wall.area;
  EXPECT_NEAR(volume, sphere_volume(14), 0.01 * sphere_volume(14));
  EXPECT_NEAR(area, kArea, 1e-9 * kArea);
  EXPECT_TRUE(std::ranges::is_sorted(parts.voxel, std::less_equal<>{}));
  // A body outside the box keeps a place for what it holds.
  for (Vec3& x : node) x.x() += 100;
  add_body(g, cover_surface(g, node, t.triangle), share_surface_by_area(g, node, t.triangle), kArea,
           parts);
  EXPECT_EQ(parts.start[2] - parts.start[1], 1U);
}

}  // namespace
}  // namespace acinus::substances
