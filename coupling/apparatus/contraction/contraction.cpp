#include "coupling/apparatus/contraction/contraction.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace acinus::coupling {

double Contraction::next_change(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Schedule& c : course) next = std::min(next, c.next(time));
  return next;
}

void Contraction::set_params(double time, std::span<dcm::Params> types) const {
  ACINUS_ASSERT(course.size() == types.size());
  for (std::size_t k = 0; k < course.size(); ++k)
    if (!course[k].entry.empty()) types[k].cortex_tension *= course[k].at(time);
}

}  // namespace acinus::coupling
