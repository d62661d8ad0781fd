#pragma once
/// What the stress suite finds wrong.

#include <string>

namespace acinus::bench {

enum class Defect {
  kNotFinite,
  kInverted,
  kCrossed,
  kTunnelled,
  kVolume,
  kLost,
  kUnborn,    ///< a cell without a mother
  kVanished,  ///< a cell that is gone although nothing ended it
  kUntimely,  ///< a birth or death that could not be, or did not come
};
const char* name_of(Defect defect);

/// Whether the bookkeeping of cells is wrong, which no run can excuse.
inline bool concerns_family(Defect d) { return d >= Defect::kUnborn; }

/// One thing wrong with one moment.
struct Finding {
  Defect defect = Defect::kNotFinite;
  double time_s = 0;
  std::string what;  ///< which cells, how much
};

}  // namespace acinus::bench
