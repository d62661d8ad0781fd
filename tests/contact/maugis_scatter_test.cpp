#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/vec.hpp"
#include "tests/contact/maugis_spheres.hpp"

namespace acinus::contact {
namespace {

using test::Scatter, test::Setting;

constexpr double kDmt = 2 * kPi * test::kSphereRadius / 2 * 0.01;  ///< nN, 2 pi W R^

/// Overlap at the largest pull of exact spheres, um, and that pull over kDmt.
struct PullOff {
  double overlap, ratio;
};

PullOff exact_pull_off(const Setting& s) {
  const MaugisPair pair = test::pair_of(s);
  const MaugisState state = maugis_pull_off(maugis_lambda(pair));
  const double radius = pair.pair.radius;
  const double unit = std::cbrt(3 * kPi * 0.01 * radius * radius / (4 * s.modulus));
  return {state.approach * unit * unit / radius, -state.load / 2};
}

/// Largest pull of each pair of orientations over kDmt, over overlaps that are `step` apart.
Scatter largest_pull(const Setting& s, double step) {
  auto random = reference::stream(s.nodes);
  const double end = least_overlap(test::pair_of(s));
  std::vector<double> ratio;
  for (int k = 0; k < s.orientations; ++k) {
    const Mat3 turn_a = reference::random_rotation(random);
    const Mat3 turn_b = reference::random_rotation(random);
    double least = 0;
    for (double overlap = end; overlap < end + 0.3; overlap += step)
      least = std::min(least, test::push(s, overlap, turn_a, turn_b));
    ratio.push_back(-least / kDmt);
  }
  return test::scatter_of(ratio);
}

// Prints the table of docs/developers/benchmarks.md: curvatures estimated from meshes leave 2e-4 of
// the force.
TEST(MaugisScatter, OfPairsOfIcospheres) {
  for (const int nodes : {162, 642})
    for (const double modulus : {10.0, 1.0}) {
      const Setting s = {nodes, modulus, false, 24};
      const PullOff exact = exact_pull_off(s);
      const Scatter largest = largest_pull(s, nodes == 162 ? 0.005 : 0.01);
      std::printf("%d nodes, %g kPa: exact %.3f, largest pull %.3f +- %.3f", nodes, modulus,
                  exact.ratio, largest.mean, largest.deviation);
      EXPECT_NEAR(largest.mean, exact.ratio, 0.02 * exact.ratio);  // overlaps 5 or 10 nm apart
      for (const double overlap : {exact.overlap + 1e-3, 0.5, 1.0}) {
        const Scatter r = test::measure(s, overlap);
        std::printf("; at %.4f um %.5f +- %.5f", overlap, r.mean, r.deviation);
        EXPECT_NEAR(r.mean, 1.0, 5e-4);
      }
      std::printf("\n");
    }
}

}  // namespace
}  // namespace acinus::contact
