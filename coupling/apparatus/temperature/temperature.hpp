#pragma once
/// Temperature of the scene over time. Friction within the cortex falls with it; nothing else
/// depends on it.

#include "core/numbers/schedule.hpp"
#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

struct Temperature final : Device {
  double activation = 55e18;  ///< fJ/mol, 1e18 are a kJ/mol
  double reference = 290;     ///< K, at which the friction of the cell types is meant
  Schedule course;            ///< K over s since t = 0; empty: always the reference

  /// Friction over that at the reference temperature.   [VanLiedekerke2020, Eq. (23)]
  double friction_factor(double time) const;

  double next_change(double time) const override;
  void set_params(double time, std::span<dcm::Params> types) const override;
};

}  // namespace acinus::coupling
