#pragma once
/// Temperature of the scene over time. Only friction within the cortex depends on it.

#include "core/numbers/schedule.hpp"
#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

struct Temperature final : Device {
  double activation = 55e18;  ///< fJ/mol (1e18 are a kJ/mol)
  double reference = 290;     ///< K, temperature of the friction given for cell types
  Schedule course;            ///< K over s since t = 0; empty: constant at the reference

  /// Friction over that at the reference temperature. [VanLiedekerke2020, Eq. (23)]
  double friction_factor(double time) const;

  double next_change(double time) const override;
  void set_params(double time, std::span<dcm::Params> types) const override;
};

}  // namespace acinus::coupling
