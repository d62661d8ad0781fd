#include "coupling/measure/contact_sums.hpp"

#include <algorithm>
#include <tuple>

namespace acinus::coupling {

CellContact& ContactSums::sum_of(const ContactForce& c) {
  if (c.b == kNoCell) return sum_[{false, c.a, c.b, c.kind, c.index}];
  return sum_[{true, std::min(c.a, c.b), std::max(c.a, c.b), {}, 0}];
}

void ContactSums::add(const ContactForce& c) {
  if (c.b == kNoCell ? c.fades : !c.touching && !c.fades) return;
  CellContact& sum = sum_of(c);
  sum.force += c.a < c.b ? c.force : Vec3(-c.force);
  sum.touching = sum.touching || c.touching;
  if (c.b == kNoCell) sum.normal_force += c.force.dot(c.normal);
}

void ContactSums::add_areas(const ContactForce& c, double area_a, double area_b) {
  if (c.a == c.b || (area_a <= 0 && area_b <= 0)) return;
  CellContact& sum = sum_of(c);
  sum.area_a += c.a < c.b ? area_a : area_b;
  sum.area_b += c.a < c.b ? area_b : area_a;
}

std::vector<CellContact> ContactSums::list(const std::vector<Vec3>& center,
                                           std::size_t n_deformable) const {
  std::vector<CellContact> list;
  for (const auto& [key, sum] : sum_) {
    CellContact& c = list.emplace_back(sum);
    std::tie(c.a, c.b, c.partner, c.index) = std::tie(key.a, key.b, key.partner, key.index);
    if (!key.pair) continue;
    c.partner = c.b < n_deformable ? contact::Partner::kSurface : contact::Partner::kSphere;
    c.normal_force = c.force.dot((center[c.a] - center[c.b]).normalized());
  }
  return list;
}

}  // namespace acinus::coupling
