#pragma once
/// Contact law of a random scene.

#include <cstdint>
#include <string>

#include "bench/stress/random_streams.hpp"
#include "core/numbers/random.hpp"

namespace acinus::bench {

/// Law between triangles, which needs the quadrature "3-point".
inline constexpr const char* kTriangleLaw = "maugis-dugdale";

/// Value of contact.law for a seed: in 15 % that between triangles. From a stream of its own, so
/// that the rest of the scene is that without it.
inline std::string draw_law(std::uint64_t seed) {
  constexpr double kShare = 0.15;
  UniformStream random(seed, Purpose::kSampling, kLawStream);
  return random.uniform() < kShare ? kTriangleLaw : "cohesive";
}

}  // namespace acinus::bench
