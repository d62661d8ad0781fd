#pragma once
/// Temperature of the scene over time, and what of the cells depends on it.

#include <vector>

#include "core/numbers/schedule.hpp"
#include "dcm/params.hpp"

namespace acinus::coupling {

/// Friction within the cortex falls with temperature; nothing else depends on it.
struct Temperature {
  double activation = 55e18;  ///< fJ/mol, 1e18 are a kJ/mol
  double reference = 290;     ///< K, at which the friction of the cell types is meant
  Schedule course;            ///< K over s since t = 0; empty: always the reference
};

/// What friction at the reference temperature is multiplied by.
/// [VanLiedekerke2020, Eq. (23)]
double friction_factor(const Temperature& temperature, double time);

/// The parameters with the frictions of the cortex (nodal_friction, series_friction) at `time`.
void set_temperature(const Temperature& temperature, double time, std::vector<dcm::Params>& params);

}  // namespace acinus::coupling
