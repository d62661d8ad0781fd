#include "calibration/law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acinus::calibration {
namespace {

void compare(const char* model, const Parameters& law, const Parameters& here,
             std::vector<std::string>& out) {
  constexpr double kSame = 1e-6;  // relative
  for (const auto& [name, value] : law) {
    const auto found = here.find(name);
    if (found == here.end()) {
      out.push_back(
          fmt::format("{}.{}: the law holds for {:.6g}, here there is none", model, name, value));
    } else if (std::abs(value - found->second) >
               kSame * std::max(std::abs(value), std::abs(found->second))) {
      out.push_back(fmt::format("{}.{}: the law holds for {:.6g}, here it is {:.6g}", model, name,
                                value, found->second));
    }
  }
  for (const auto& [name, value] : here)
    if (!law.contains(name))
      out.push_back(
          fmt::format("{}.{}: the law does not say, here it is {:.6g}", model, name, value));
}

}  // namespace

cbm::StiffnessLaw stiffness_law(const Law& law) {
  cbm::StiffnessLaw s;
  if (law.table.empty()) s.term.push_back({law.a1, law.power});
  for (const TableEntry& e : law.table) s.table.push_back({e.overlap, e.modulus - law.a0});
  s.range = law.overlap_range[1];
  s.wall_recess = law.wall_recess;
  return s;
}

std::vector<std::string> list_differences(const Law& law, const Parameters& dcm,
                                          const Parameters& cbm) {
  std::vector<std::string> out;
  compare("dcm", law.dcm, dcm, out);
  compare("cbm", law.cbm, cbm, out);
  return out;
}

}  // namespace acinus::calibration
