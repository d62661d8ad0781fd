#include "runs/scene/scene_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/spelling.hpp"
#include "core/units/units.hpp"
#include "runs/scene/apparatus/apparatus.hpp"
#include "runs/scene/quoted_quantity.hpp"

namespace acinus::runs {
namespace {

std::string adhesion_text(double value) {
  return "\"" + format_quantity(value, kTension, "J/m^2") + "\"";
}

std::vector<std::string> type_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, type] : scene.cell_types) names.push_back(name);
  return names;
}

/// Checks low < high in every coordinate.
void check_box(const Vec3& low, const Vec3& high, const std::string& low_pointer,
               const std::string& high_pointer, Report& report) {
  for (int axis = 0; axis < 3; ++axis) {
    if (low[axis] < high[axis]) continue;
    const std::string above = fmt::format("{}/{}", high_pointer, axis);
    report.add_relation({fmt::format("{}/{}", low_pointer, axis), above}, quoted_length(low[axis]),
                        fmt::format("must be below {} = {}", above, quoted_length(high[axis])));
  }
}

/// Checks that keys for reading a network stand beside a network to read.
void check_vessels(const Scene& scene, Report& report) {
  if (!scene.vessels.file.empty() || scene.lobule) return;
  const VesselBlock given = scene.vessels, plain;
  const std::pair<const char*, bool> keys[] = {
      {"radius_array", given.radius_array != plain.radius_array},
      {"unit", given.unit != plain.unit},
      {"scale", given.scale != plain.scale},
      {"radius_scale", given.radius_scale != plain.radius_scale},
      {"shift", given.shift != plain.shift},
      {"center", given.center != plain.center},
      {"crop", given.crop.has_value()}};
  for (const auto& [key, changed] : keys)
    if (changed)
      report.add_relation({fmt::format("/vessels/{}", key), "/vessels/file"}, "",
                          "is for a network that is read, and none is: give /vessels/file, on the "
                          "command line --set vessels.file=my_network.vtk");
}

/// Checks flexible vessels. They exclude sleep, which steps cells without the vessels they lie on.
void check_flexible_vessels(const Scene& scene, Report& report) {
  const VesselBlock& v = scene.vessels;
  if (v.file.empty() && !scene.lobule && v.flexible)
    report.add_relation({"/vessels/flexible", "/vessels/file", "/lobule"}, "true",
                        "needs vessels: give /vessels/file or a lobule block");
  if (v.flexible && v.contact == VesselWalls::kMesh)
    report.add_relation({"/vessels/flexible", "/vessels/contact"}, "true",
                        "goes with cones only, which follow the vessels: set /vessels/contact to "
                        "\"cones\"");
  if (v.flexible && scene.life.sleep)
    report.add_relation({"/vessels/flexible", "/life/sleep"}, "true",
                        "goes only where all cells are awake: set /life/sleep to false");
}

void check_start_up(const Scene& scene, Report& report) {
  if (!scene.start_up.enabled) {
    if (!scene.start_up.from.empty())
      report.add_relation({"/start_up/from", "/start_up/enabled"}, "",
                          "stands for a start-up that another run made: set /start_up/enabled to "
                          "true, as there");
    return;
  }
  const double initial = scene.start_up.initial_radius;
  for (const auto& [name, type] : scene.cell_types) {
    if (initial < type.radius) continue;
    const std::string pointer = "/cell_types/" + name + "/radius";
    report.add_relation({"/start_up/initial_radius", pointer}, quoted_length(initial),
                        fmt::format("must be below {} = {}: cells grow during start-up", pointer,
                                    quoted_length(type.radius)));
  }
  for (std::size_t i = 0; i < scene.cells.list.size(); ++i) {
    const std::optional<double>& radius = scene.cells.list[i].radius;
    if (!radius || initial < *radius) continue;
    const std::string pointer = fmt::format("/cells/list/{}/radius", i);
    report.add_relation({pointer, "/start_up/initial_radius"}, quoted_length(*radius),
                        fmt::format("must exceed /start_up/initial_radius = {}: cells grow during "
                                    "start-up",
                                    quoted_length(initial)));
  }
}

void check_list(const Scene& scene, Report& report) {
  const CellsBlock& cells = scene.cells;
  const std::vector<std::string> names = type_names(scene);
  if (cells.list.empty()) {
    report.add_relation({"/cells/list", "/cells/source"}, "",
                        "has no entry, but /cells/source = \"list\". Add cells, or take another "
                        "source: clump, box, fill, lobule");
  }
  for (std::size_t i = 0; i < cells.list.size(); ++i) {
    const CellEntry& cell = cells.list[i];
    const std::string pointer = fmt::format("/cells/list/{}/type", i);
    if (cell.type.empty()) {
      if (names.size() > 1) {
        report.add_relation({pointer}, "",
                            fmt::format("is missing: there are {} cell types: {}", names.size(),
                                        fmt::join(names, ", ")));
      }
    } else {
      check_type_name(scene, cell.type, pointer, report);
    }
  }
}

/// Checks the types of generated cells.
void check_types(const Scene& scene, Report& report) {
  const CellsBlock& cells = scene.cells;
  if (cells.types.empty() && cells.source != CellSource::kList && scene.cell_types.size() > 1) {
    report.add_relation({"/cells/types", "/cells/source"}, "",
                        fmt::format("is empty, but there are {} cell types: {}. Say which cells of "
                                    "source \"{}\" are of which, or take one out",
                                    scene.cell_types.size(), fmt::join(type_names(scene), ", "),
                                    name_of_choice(cells.source)));
  }
  if (cells.types.empty()) return;
  if (cells.source == CellSource::kList) {
    report.add_relation({"/cells/types", "/cells/source"}, "",
                        "is for cells that are not listed: with /cells/source = \"list\" every "
                        "cell names its type");
    return;
  }
  bool anywhere = false;
  for (std::size_t i = 0; i < cells.types.size(); ++i) {
    const TypeShare& t = cells.types[i];
    const std::string pointer = fmt::format("/cells/types/{}", i);
    check_type_name(scene, t.type, pointer + "/type", report);
    if (t.region) check_region(*t.region, pointer + "/region", report);
    anywhere = anywhere || !t.region || t.region->kind == RegionKind::kAll;
  }
  if (!anywhere) {
    report.add_relation({"/cells/types"}, "",
                        "needs an entry without a region, for cells that are in none");
  }
}

void check_cells(const Scene& scene, Report& report) {
  const CellsBlock& cells = scene.cells;
  const CellModel model = model_of(scene);
  if (cells.source == CellSource::kList) check_list(scene, report);
  check_types(scene, report);
  if (cells.source == CellSource::kLobule && !scene.lobule) {
    report.add_relation({"/cells/source", "/lobule"}, "\"lobule\"",
                        "needs a lobule block (acinus explain lobule)");
  }
  if (!scene.zoom.empty() && model != CellModel::kZoom && !scene.model) {
    report.add_relation({"/zoom", "/cells/model"}, "",
                        fmt::format("zoom regions need /cells/model = \"zoom\", not \"{}\". Remove "
                                    "the regions (--set zoom=[]) or change the model",
                                    name_of_choice(model)));
  }
  if (cells.source == CellSource::kMeshes && scene.start_up.enabled) {
    report.add_relation({"/cells/source", "/start_up/enabled"}, "\"meshes\"",
                        "gives cells the shape and size that they start with. Set "
                        "/start_up/enabled to false");
  }
  if (cells.source == CellSource::kFill)
    check_box(cells.low, cells.high, "/cells/low", "/cells/high", report);
  bool all_chosen = cells.source == CellSource::kList && !cells.list.empty();
  for (const CellEntry& cell : cells.list) all_chosen = all_chosen && cell.model.has_value();
  if (scene.zoom.empty() && model == CellModel::kZoom && !all_chosen) {
    report.add_relation(
        {scene.model ? "/model" : "/cells/model", "/zoom"}, "\"zoom\"",
        "needs at least one region in /zoom. Add one, or choose \"dcm\" or \"cbm\"");
  }
}

void check_normal(const Vec3& normal, const std::string& pointer, Report& report) {
  if (normal.norm() > 1e-12) return;
  report.add_relation({pointer}, "[0, 0, 0]",
                      "must not be zero: it is the direction of the plane's normal");
}

void check_lobule(const Scene& scene, Report& report) {
  if (!scene.lobule) return;
  const LobuleBlock& lobule = *scene.lobule;
  const auto below = [&report](const char* small_name, double small, const char* large_name,
                               double large) {
    if (small < large) return;
    const std::string pointer_a = std::string("/lobule/") + small_name;
    const std::string pointer_b = std::string("/lobule/") + large_name;
    report.add_relation({pointer_a, pointer_b}, quoted_length(small),
                        fmt::format("must be below {} = {}", pointer_b, quoted_length(large)));
  };
  below("central_vein_radius", lobule.central_vein_radius, "lesion_radius", lobule.lesion_radius);
  below("lesion_radius", lobule.lesion_radius, "radius", lobule.radius);
  below("portal_vein_radius", lobule.portal_vein_radius, "radius", lobule.radius);
  below("sinusoid_radius", lobule.sinusoid_radius, "radius", lobule.radius);
}

void check_boundary(const Scene& scene, Report& report) {
  if (scene.vessels.crop) {
    check_box((*scene.vessels.crop)[0], (*scene.vessels.crop)[1], "/vessels/crop/0",
              "/vessels/crop/1", report);
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const WallEntry& wall = scene.walls[i];
    const std::string pointer = fmt::format("/walls/{}", i);
    check_normal(wall.normal, pointer + "/normal", report);
    if (wall.speed != 0 && wall.travel == 0) {
      report.add_relation({pointer + "/travel", pointer + "/speed"}, quoted_length(wall.travel),
                          "must be > 0 um for a wall that moves");
    }
    if (wall.mirror && wall.adhesion > 0) {
      report.add_relation({pointer + "/adhesion", pointer + "/mirror"},
                          adhesion_text(wall.adhesion),
                          fmt::format("a mirror wall stands for equal cells and does not adhere. "
                                      "Set {}/mirror to false",
                                      pointer));
    }
    if (!names.insert(wall.name).second) {
      report.add_relation({pointer + "/name"}, "\"" + wall.name + "\"",
                          "another wall has this name");
    }
  }
  names.clear();
  for (std::size_t i = 0; i < scene.static_meshes.size(); ++i) {
    if (!names.insert(scene.static_meshes[i].name).second) {
      report.add_relation({fmt::format("/static_meshes/{}/name", i)},
                          "\"" + scene.static_meshes[i].name + "\"", "another mesh has this name");
    }
  }
  const CapsuleEntry& capsule = scene.capsule;
  if (!capsule.enabled) return;
  if (capsule.min_radius > capsule.radius) {
    report.add_relation(
        {"/capsule/min_radius", "/capsule/radius"}, quoted_length(capsule.min_radius),
        fmt::format("must not exceed /capsule/radius = {}", quoted_length(capsule.radius)));
  } else if (capsule.speed > 0 && capsule.min_radius == 0) {
    report.add_relation({"/capsule/min_radius", "/capsule/speed"},
                        quoted_length(capsule.min_radius),
                        "must be > 0 um for a capsule that shrinks");
  } else if (!scene.cell_types.empty()) {
    const auto largest = std::ranges::max_element(
        scene.cell_types, {}, [](const auto& type) { return type.second.radius; });
    const bool shrinks = capsule.speed > 0;
    const double least = shrinks ? capsule.min_radius : capsule.radius;
    if (least <= largest->second.radius)
      report.add_relation({shrinks ? "/capsule/min_radius" : "/capsule/radius", "/cell_types"},
                          quoted_length(least),
                          fmt::format("must exceed the radius of \"{}\" cells, {}", largest->first,
                                      quoted_length(largest->second.radius)));
  }
}

}  // namespace

void check_type_name(const Scene& scene, const std::string& type, const std::string& pointer,
                     Report& report) {
  const std::vector<std::string> names = type_names(scene);
  if (type.empty() || names.empty() || scene.cell_types.contains(type)) return;
  const std::string known = fmt::format("Known: {}", fmt::join(names, ", "));
  report.add_relation({pointer, "/cell_types"}, "\"" + type + "\"",
                      "unknown cell type. " + did_you_mean(nearest_name(type, names), known));
}

void check_region(const Region& region, const std::string& pointer, Report& report) {
  if (coupling::moves(region.kind) && !pointer.starts_with("/zoom/"))
    report.add_relation({pointer + "/kind"}, "\"" + name_of_choice(region.kind) + "\"",
                        "moves with the tissue, which only regions of /zoom can do. Choose sphere, "
                        "box, half_space, axis_distance or all");
  if (region.kind == RegionKind::kBox)
    check_box(region.low, region.high, pointer + "/low", pointer + "/high", report);
  if (region.kind == RegionKind::kHalfSpace)
    check_normal(region.normal, pointer + "/normal", report);
  if (region.kind == RegionKind::kAxisDistance && region.min_distance >= region.max_distance) {
    report.add_relation({pointer + "/min_distance", pointer + "/max_distance"},
                        quoted_length(region.min_distance),
                        fmt::format("must be below {}/max_distance = {}", pointer,
                                    quoted_length(region.max_distance)));
  }
}

void check_rules(const Scene& scene, Report& report, SceneRule of_experiment) {
  check_times(scene, report);
  if (of_experiment != nullptr) of_experiment(scene, report);
  check_vessels(scene, report);
  check_flexible_vessels(scene, report);
  check_contact_law(scene, report);
  check_pair_adhesions(scene, report);
  check_single_cell(scene, report);
  check_inside(scene, report);
  check_apparatus(scene, report);
  check_start_up(scene, report);
  check_cells(scene, report);
  check_zoom(scene, report);
  check_life(scene, report);
  check_substances(scene, report);
  check_lobule(scene, report);
  check_boundary(scene, report);
}

}  // namespace acinus::runs
