#pragma once
/// Constants of a substance: medium, faces of the box, exchange with bodies.

#include <array>
#include <cstdint>
#include <vector>

namespace acinus::substances {

enum class FaceKind : std::uint8_t { kNoFlux, kFixed, kExchange };

/// Condition on one face of the box.
struct FaceCondition {
  FaceKind kind = FaceKind::kNoFlux;
  double value = 0;        ///< concentration outside
  double coefficient = 0;  ///< um/s, kExchange: flux into the box = coefficient (value - c at face)
};

struct Medium {
  double diffusion = 0;                 ///< um^2/s
  double decay = 0;                     ///< 1/s
  std::array<FaceCondition, 6> face{};  ///< x low, x high, y low, y high, z low, z high
  /// Sources that stay in place, such as vessels: gain - loss c.  [n_voxel] or empty
  std::vector<double> gain;  ///< concentration / s
  std::vector<double> loss;  ///< 1/s
  /// The same of walls, with a substance that is kept out of obstacles: per volume of a voxel,
  /// however much of it is open; those of closed voxels act on the open ones near by.
  std::vector<double> wall_gain, wall_loss;
};

/// Exchange of a body with its surroundings per volume of the body, in concentration per s:
/// secretion (1 - c / saturation) - uptake c - uptake_max c / (half_max + c).
struct Exchange {
  double secretion = 0;   ///< concentration / s
  double saturation = 0;  ///< concentration at which secretion ends; 0: it never does
  double uptake = 0;      ///< 1/s
  double uptake_max = 0;  ///< concentration / s, Michaelis-Menten
  double half_max = 1;    ///< concentration of half that rate
  bool acts() const { return secretion > 0 || uptake > 0 || uptake_max > 0; }
};

}  // namespace acinus::substances
