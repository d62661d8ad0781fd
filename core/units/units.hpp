#pragma once
/// Quantities with units. The program computes in um, s, nN, K, mol; text carries any unit of the
/// table. This is the only place where units are converted.

#include <string>
#include <string_view>
#include <vector>

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

/// Reads "5e10 N s/m^3" and returns the value in base units (um, s, nN, K, mol).
/// Units: m dm cm mm um nm, d h min s ms us, N mN uN nN pN, Pa kPa MPa GPa, kJ J mJ uJ nJ pJ fJ aJ,
/// W mW uW, K, mol, %.
/// Products by space or *, quotients by /, powers by ^, parentheses; evaluated from left to right,
/// so that "J/m^2/s" = "J/(m^2 s)". Powers of ten enter the decimal exponent before the one
/// rounding to double, so "1e8 N s/m^3" is exactly 0.1; minutes, hours and days cost one more
/// rounding.
/// @throws Error: no number, bare number, unknown unit (with a hint), other dimension than needed
///         (both named), text left over, nan, inf, or a value outside the range of a double.
double parse_quantity(std::string_view text, Dimension needed);

/// Writes a value in base units with the given unit, by the fewest digits that parse_quantity reads
/// back to the same double. Should no such digits exist in that unit, base units are written
/// instead. A dimensionless value has unit "" and is a plain number.
/// @throws Error: the unit does not have the dimension, or the value is not finite.
std::string format_quantity(double value, Dimension dimension, std::string_view unit);

/// "force/length^2", "1/time", "a plain number".
std::string dimension_formula(Dimension dimension);

/// What such a quantity is called, with its article: "a stress"; "" when it has no name here.
std::string dimension_name(Dimension dimension);

/// A quantity of this dimension as a user would write it: "12 um"; built from base units if
/// unnamed.
std::string dimension_example(Dimension dimension);

/// Base units of a dimension: "nN s/um^3".
std::string base_unit(Dimension dimension);

/// Every unit symbol of the table.
std::vector<std::string> unit_symbols();

}  // namespace acinus
