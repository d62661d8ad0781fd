#include "coupling/apparatus/temperature/temperature.hpp"

#include "core/numbers/arrhenius.hpp"

namespace acinus::coupling {

double Temperature::friction_factor(double time) const {
  if (course.entry.empty()) return 1;
  return arrhenius_factor(activation, course.at(time), reference);
}

double Temperature::next_change(double time) const { return course.next(time); }

void Temperature::set_params(double time, std::span<dcm::Params> types) const {
  const double factor = friction_factor(time);
  for (dcm::Params& p : types) {
    p.nodal_friction *= factor;
    p.series_friction *= factor;
  }
}

}  // namespace acinus::coupling
