#pragma once
/// Unit part of a quantity: "N s/m^3". For units.cpp; others use units.hpp.

#include <string_view>

#include "core/units/dimension.hpp"

namespace acinus {

/// Product of unit powers.
struct Scale {
  Dimension dimension;
  int ten = 0;
  double numerator = 1, denominator = 1;  ///< powers of 60, 3600, 86400; exact integers below 2^53
};

/// True for an ASCII digit: std::isdigit() depends on the locale.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Parses the unit part of a quantity.
/// @param whole  the quantity, for messages
/// @throws Error: an unknown unit (with a hint), text that is no product of units
Scale parse_unit(std::string_view text, std::string_view whole);

}  // namespace acinus
