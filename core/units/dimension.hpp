#pragma once
/// Dimensions of quantities, and their names and base units.

#include <string>

namespace acinus {

/// Exponents of length, time and force. Mass never appears: overdamped tissue has no inertia.
struct Dimension {
  int length = 0, time = 0, force = 0, temperature = 0, amount = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

inline constexpr Dimension kDimensionless{};
inline constexpr Dimension kLength{1, 0, 0};
inline constexpr Dimension kTime{0, 1, 0};
inline constexpr Dimension kForce{0, 0, 1};
inline constexpr Dimension kSpeed{1, -1, 0};
inline constexpr Dimension kRate{0, -1, 0};
inline constexpr Dimension kDiffusion{2, -1, 0};
inline constexpr Dimension kNumberDensity{-3, 0, 0};
inline constexpr Dimension kStress{-2, 0, 1};
inline constexpr Dimension kTension{-1, 0, 1};  ///< also energy per area
inline constexpr Dimension kEnergy{1, 0, 1};
inline constexpr Dimension kStiffnessPerArea{-3, 0, 1};  ///< stress per length
inline constexpr Dimension kFriction{-1, 1, 1};          ///< force per speed
inline constexpr Dimension kFrictionPerArea{-3, 1, 1};
inline constexpr Dimension kViscosity{-2, 1, 1};
inline constexpr Dimension kPower{1, -1, 1};
inline constexpr Dimension kTemperature{0, 0, 0, 1, 0};
inline constexpr Dimension kMolarEnergy{1, 0, 1, 0, -1};

/// Formula of a dimension: "force/length^2", "1/time", "a plain number".
std::string dimension_formula(Dimension dimension);

/// Name of a quantity of this dimension, with its article: "a stress"; "" if it has none here.
std::string dimension_name(Dimension dimension);

/// Example of a quantity of this dimension as a user would write it: "12 um"; built from base units
/// if the dimension has no name.
std::string dimension_example(Dimension dimension);

/// Base units of a dimension: "nN s/um^3".
std::string base_unit(Dimension dimension);

}  // namespace acinus
