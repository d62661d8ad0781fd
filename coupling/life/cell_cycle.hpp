#pragma once
/// Cell cycle: drawn cycle times and ages, growth, contact inhibition.

#include <cstdint>

#include "core/numbers/ramp.hpp"
#include "coupling/world/cycle.hpp"

namespace acinus::coupling {

/// Cycle time of a cell, s: mean of the type with a Gaussian deviation.
double draw_cycle_time(const CycleParams& p, std::uint64_t seed, std::int64_t lineage);

/// Initial age of a cell as a share of its cycle, [0, 1): its reference volume is (1 + age) times
/// that at birth. 0 unless the type starts at random ages.
double draw_start_age(const CycleParams& p, std::uint64_t seed, std::int64_t lineage);

/// Reference volume over time: grows at alpha = birth volume / cycle time until doubled.
/// [VanLiedekerke2020, Eq. (18)]
/// @param factor  of growth_factor; 0 keeps the volume
Ramp growth_from(const Cycle& cycle, double volume_now, double time, double factor);

/// Input of contact inhibition.
struct Crowding {
  double pressure = 0;         ///< kPa, contact pressure
  double relative_volume = 1;  ///< V / V0
  double density = 0;          ///< cells per um^3 around the cell
};

/// Share of the free growth rate: 1 / (1 + (x / x0)^n) by pressure or density, x^n / (1 + x^n) with
/// x = (V / V0) / threshold by volume.
double growth_factor(const Inhibition& p, const Crowding& now);

}  // namespace acinus::coupling
