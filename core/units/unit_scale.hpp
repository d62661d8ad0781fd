#pragma once
/// Units that are known only at run time: of a column of a file, of an observable.

#include <string_view>

#include "core/units/dimension.hpp"

namespace acinus {

struct UnitScale {
  Dimension dimension;
  double in_base = 1;  ///< one of the unit in base units (um, s, nN, K, mol)
};

/// Dimension and size of a unit.
/// @param unit  "kPa", "1/um^3", "d"; "" and "1" are dimensionless
/// @throws Error naming the part that is not understood
UnitScale scale_of_unit(std::string_view unit);

}  // namespace acinus
