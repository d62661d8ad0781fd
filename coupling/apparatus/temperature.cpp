#include "coupling/apparatus/temperature.hpp"

#include "core/numbers/arrhenius.hpp"

namespace acinus::coupling {

double friction_factor(const Temperature& t, double time) {
  if (t.course.entry.empty()) return 1;
  return arrhenius_factor(t.activation, t.course.at(time), t.reference);
}

void set_temperature(const Temperature& t, double time, std::vector<dcm::Params>& params) {
  const double factor = friction_factor(t, time);
  for (dcm::Params& p : params) {
    p.nodal_friction *= factor;
    p.series_friction *= factor;
  }
}

}  // namespace acinus::coupling
