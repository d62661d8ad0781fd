#pragma once
/// Findings of the stress suite.

#include <string>

namespace acinus::bench {

/// Kinds of physically impossible states and of faults in the bookkeeping of cells.
enum class Defect {
  kNotFinite,
  kInverted,
  kCrossed,
  kTunnelled,
  kVolume,
  kLost,
  kUnborn,    ///< cell without a mother
  kVanished,  ///< cell missing without an event
  kUntimely,  ///< impossible or missing birth or death
};
const char* name_of(Defect defect);

/// True for faults in the bookkeeping of cells, which no report of the run can excuse.
inline bool concerns_family(Defect d) { return d >= Defect::kUnborn; }

/// Fault found at one time.
struct Finding {
  Defect defect = Defect::kNotFinite;
  double time_s = 0;
  std::string what;  ///< cells concerned and size
};

}  // namespace acinus::bench
