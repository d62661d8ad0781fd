#include "runs/assemble/cell_types.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "core/numbers/random.hpp"
#include "coupling/world/region.hpp"

namespace acinus::runs {

const std::string& draw_cell_type(const Scene& scene, std::int64_t number, const Vec3& center) {
  const std::vector<TypeShare>& types = scene.cells.types;
  if (types.empty()) return scene.cell_types.begin()->first;
  const auto is_here = [&](const TypeShare& t) {
    return t.region && coupling::in_region(*t.region, scene.axis_point, center);
  };
  const bool anywhere = std::ranges::none_of(types, is_here);
  std::vector<const TypeShare*> choice;
  double sum = 0;
  for (const TypeShare& t : types)
    if (anywhere ? !t.region : is_here(t)) {
      choice.push_back(&t);
      sum += t.share;
    }
  ACINUS_ASSERT(!choice.empty());  // check_rules wants an entry for anywhere
  // An address of its own: the cell's orientation is drawn from the stream of the same id.
  double left =
      sum * uniform({scene.seed, Purpose::kPlacement, static_cast<std::uint64_t>(number) + 1});
  for (const TypeShare* t : choice)
    if ((left -= t->share) < 0) return t->type;
  return choice.back()->type;
}

double largest_radius(const Scene& scene) {
  const std::vector<TypeShare>& types = scene.cells.types;
  if (types.empty()) return scene.cell_types.begin()->second.radius;
  double radius = 0;
  for (const TypeShare& t : types) radius = std::max(radius, scene.cell_types.at(t.type).radius);
  return radius;
}

}  // namespace acinus::runs
