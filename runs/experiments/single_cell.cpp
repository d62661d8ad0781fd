#include "runs/experiments/single_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runs/scene/quoted_quantity.hpp"

namespace acinus::runs {
namespace {

constexpr int kSides = 36;

/// Rule: the pipette is narrower than a cell that it is to deform.
void check_pipette_radius(const Scene& scene, double radius, Report& report) {
  for (const auto& [name, type] : scene.cell_types) {
    if (!(radius >= type.radius)) continue;
    const std::string pointer = "/cell_types/" + name + "/radius";
    report.add_relation({"/pipette/radius", pointer}, quoted_length(radius),
                        fmt::format("must be below {} = {}: the cell would slip through", pointer,
                                    quoted_length(type.radius)));
  }
}

}  // namespace

std::vector<Vec3> first_cell(const coupling::World& world) {
  std::vector<Vec3> node;
  if (world.state.dcm.n_lane() > 0 && world.state.dcm.active(0))
    dcm::copy_nodes(world.state.dcm, 0, node);
  return node;
}

double extent(std::span<const Vec3> points, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : points) {
    low = std::min(low, x.dot(direction));
    high = std::max(high, x.dot(direction));
  }
  return high - low;
}

double extent_across(std::span<const Vec3> points, const Vec3& axis) {
  const Vec3 a = axis.unitOrthogonal(), b = axis.cross(a);
  double sum = 0;
  for (int k = 0; k < kSides; ++k) {
    const double angle = kPi * k / kSides;
    sum += extent(points, std::cos(angle) * a + std::sin(angle) * b);
  }
  return sum / kSides;
}

void check_one_deformable_cell(const Scene& scene, Report& report) {
  const std::string name = "\"" + name_of_choice(scene.experiment) + "\"";
  if (scene.cells.source != CellSource::kList || scene.cells.list.size() != 1)
    report.add_relation({"/experiment", "/cells/list", "/cells"}, name,
                        "looks at one cell: give /cells/list with one entry");
  if (model_of(scene) == CellModel::kCbm)
    report.add_relation({"/experiment", "/cells/model"}, name,
                        "is for deformable cells: set /cells/model to \"dcm\"");
}

bool check_pipette_experiment(const Scene& scene, Report& report) {
  check_one_deformable_cell(scene, report);
  if (!scene.pipette) {
    report.add_relation({"/experiment", "/pipette"}, "\"" + name_of_choice(scene.experiment) + "\"",
                        "needs a pipette block (acinus explain pipette)");
    return false;
  }
  check_pipette_radius(scene, scene.pipette->radius, report);
  return true;
}

}  // namespace acinus::runs
