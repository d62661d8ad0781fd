#pragma once
/// Properties of the surface of any network.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/closed.hpp"
#include "geometry/implicit/vessel_mesh.hpp"
#include "geometry/measures.hpp"
#include "geometry/remesh.hpp"
#include "tests/geometry/implicit/random_network.hpp"

namespace acinus::geometry {

/// Distance of a place to the wall of the nearest segment over the radius there.
inline double off_wall(const geometry::Network& n, const Vec3& x) {
  double least = 1e300, radius = 1;
  for (std::size_t s = 0; s < n.segment.size(); ++s) {
    const geometry::NearestBall ball = geometry::find_nearest_ball(
        x, n.node[n.segment[s][0]], n.node[n.segment[s][1]], n.radius[s][0], n.radius[s][1]);
    const double d = ball.apart.norm() - ball.radius;
    if (d < least) least = d, radius = ball.radius;
  }
  return std::abs(least) / radius;
}

/// Deviation of the middles of all triangles; those across a crease do not follow it.
struct Deviation {
  double rms = 0, beyond = 0;  ///< share of them farther than 5 % of the radius
};
inline Deviation find_deviation(const geometry::Network& n, const geometry::Surface& s) {
  constexpr double kFar = 0.05;
  Deviation d;
  for (const auto& [i, j, k] : s.triangle) {
    const double at = off_wall(n, (s.node[i] + s.node[j] + s.node[k]) / 3);
    d.rms += at * at;
    d.beyond += at > kFar ? 1 : 0;
  }
  const auto count = static_cast<double>(s.triangle.size());
  return {std::sqrt(d.rms / count), d.beyond / count};
}

inline void expect_sound(const geometry::Network& network, const VesselMesh& m,
                         const std::string& what) {
  EXPECT_NO_THROW(geometry::check_manifold(m.surface, what));
  EXPECT_FALSE(geometry::crosses_itself(m.surface)) << what;
  EXPECT_EQ(m.found.parts, m.expected.parts) << what;
  EXPECT_EQ(m.found.euler_number, m.expected.euler_number) << what;
  const UnionVolume sampled = sample_union(network, 20000, 1);
  const double volume = geometry::compute_volume(m.surface.node, m.surface.triangle);
  EXPECT_NEAR(volume, sampled.volume, 0.01 * sampled.volume + 2 * sampled.deviation) << what;
}

}  // namespace acinus::geometry
