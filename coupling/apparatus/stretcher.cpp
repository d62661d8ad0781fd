#include "coupling/apparatus/stretcher.hpp"

#include <algorithm>
#include <limits>

namespace acinus::coupling {

dcm::StretchLoad stretch_at(const Stretcher& s, double time) {
  const bool shines = std::ranges::any_of(
      s.pulse, [time](const Pulse& p) { return p.from <= time && time < p.to; });
  return {s.axis.normalized(), s.exponent, shines ? dcm::stress_amplitude(s.beams) : 0};
}

double next_switch(const Stretcher& s, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Pulse& p : s.pulse)
    for (const double moment : {p.from, p.to})
      if (moment > time) next = std::min(next, moment);
  return next;
}

}  // namespace acinus::coupling
