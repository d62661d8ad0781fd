#pragma once
/// Quantities with units. The program computes in um, s, nN, K, mol; text carries any unit of the
/// table. This is the only place where units are converted.

#include <string>
#include <string_view>

#include "core/units/dimension.hpp"

namespace acinus {

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

/// A unit that is known only at run time: of a column of a file, of an observable.
struct UnitScale {
  Dimension dimension;
  double in_base = 1;  ///< one of the unit in base units (um, s, nN, K, mol)
};

/// Dimension and size of a unit.
/// @param unit  "kPa", "1/um^3", "d"; "" and "1" are dimensionless
/// @throws Error naming the part that is not understood
UnitScale scale_of_unit(std::string_view unit);

}  // namespace acinus
