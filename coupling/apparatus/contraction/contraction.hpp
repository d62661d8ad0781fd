#pragma once
/// Active tension of the cortex over time. Its distribution over the surface belongs to the model:
/// dcm::ContractileRing.

#include <vector>

#include "core/numbers/schedule.hpp"
#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

struct Contraction final : Device {
  std::vector<Schedule> course;  ///< [type] factor on cortex_tension over s since t = 0; empty: 1

  double next_change(double time) const override;
  /// @pre a course for every type
  void set_params(double time, std::span<dcm::Params> types) const override;
};

}  // namespace acinus::coupling
