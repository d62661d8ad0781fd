#include <fmt/format.h>

#include "core/units/units.hpp"
#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Smallest distance of a face of the coarsest mesh from its centre, over the radius of the sphere
/// of its volume.
constexpr double kInnerRadius = 0.9;

/// Smallest radius that a cell of a type has at the start, um, and the key that gives it.
struct Smallest {
  double radius;
  std::string pointer;
};
Smallest find_smallest(const Scene& scene, const std::string& name, const CellType& type) {
  Smallest s{type.radius, "/cell_types/" + name + "/radius"};
  for (std::size_t k = 0; k < scene.cells.list.size(); ++k) {
    const CellEntry& c = scene.cells.list[k];
    if ((c.type.empty() || c.type == name) && c.radius && *c.radius < s.radius)
      s = {*c.radius, fmt::format("/cells/list/{}/radius", k)};
  }
  if (scene.start_up.enabled && scene.start_up.initial_radius < s.radius)
    s = {scene.start_up.initial_radius, "/start_up/initial_radius"};
  return s;
}

void check_nucleus(const Scene& scene, const std::string& name, const CellType& type,
                   Report& report) {
  if (!type.dcm.nucleus) return;
  const dcm::Nucleus& n = *type.dcm.nucleus;
  const std::string dcm = "/cell_types/" + name + "/dcm", pointer = dcm + "/nucleus";
  if (n.nodes > type.dcm.nodes)
    report.add_relation({pointer + "/nodes", dcm + "/nodes"}, fmt::format("{}", n.nodes),
                        fmt::format("must not exceed {}/nodes = {}", dcm, type.dcm.nodes));
  const Smallest cell = find_smallest(scene, name, type);
  if (n.size * cell.radius + n.gap > kInnerRadius * cell.radius)
    report.add_relation(
        {pointer + "/size", pointer + "/gap", cell.pointer}, fmt::format("{:g}", n.size),
        fmt::format("is too large: that share of {} = {} and {}/gap = {} beside it must fit into "
                    "{:g} of that radius. Make the nucleus smaller or the cell larger",
                    cell.pointer, quoted_length(cell.radius), pointer, quoted_length(n.gap),
                    kInnerRadius));
}

}  // namespace

void check_inside(const Scene& scene, Report& report) {
  for (const auto& [name, type] : scene.cell_types) check_nucleus(scene, name, type, report);
}

}  // namespace acinus::runs
