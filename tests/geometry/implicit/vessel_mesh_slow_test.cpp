#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "core/parallel/clock.hpp"
#include "geometry/implicit/vessel_mesh.hpp"
#include "tests/geometry/implicit/expect_vessel_mesh.hpp"
#include "tests/geometry/implicit/random_network.hpp"

namespace acinus::geometry {
namespace {

constexpr unsigned kAtOnce = 20;

/// Drawn networks, a hundred, some of a thousand segments, so many to a test.
class RandomNetworks : public testing::TestWithParam<unsigned> {};

TEST_P(RandomNetworks, HaveSoundMeshes) {
  unsigned remeshed = 0;
  for (unsigned seed = GetParam(); seed < GetParam() + kAtOnce; ++seed) {
    const std::size_t n_segment = seed % 20 == 0 ? 1000 : 5 + 13 * (seed % 20);
    const double thickest = seed % 3 == 0 ? 20 : seed % 3 == 1 ? 2 : 6;
    const geometry::Network n = RandomNetwork(seed, 1, thickest).grow(n_segment);
    const std::string what = fmt::format("seed {}, {} segments", seed, n_segment);
    double at = wall_seconds();
    const VesselMesh raw = make_vessel_mesh(n, {});
    const double raw_s = wall_seconds() - at;
    expect_sound(n, raw, what);
    const Deviation d = find_deviation(n, raw.surface);
    EXPECT_LT(d.beyond, 0.05) << what;
    VesselMeshOptions o;
    o.edge = 0.7;
    at = wall_seconds();
    const VesselMesh even = make_vessel_mesh(n, o);
    const double even_s = wall_seconds() - at;
    expect_sound(n, even, what + ", even");
    remeshed += even.remeshed ? 1 : 0;
    fmt::print("{}: {} triangles {:.2f} s, fineness {:.2f}, rms {:.3f}; even {} {} {:.1f} s\n",
               what, raw.surface.triangle.size(), raw_s, raw.fineness, d.rms, even.remeshed,
               even.surface.triangle.size(), even_s);
    std::fflush(stdout);
  }
  EXPECT_GE(remeshed, kAtOnce - 1);
}

INSTANTIATE_TEST_SUITE_P(VesselMesh, RandomNetworks, testing::Range(1u, 101u, kAtOnce),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace acinus::geometry
