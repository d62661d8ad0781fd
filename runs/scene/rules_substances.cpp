/// Rules of substances, exchange and the responses of cells.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/spelling.hpp"
#include "runs/scene/quoted_quantity.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

std::vector<std::string> substance_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const SubstanceBlock& s : scene.substances) names.push_back(s.name);
  return names;
}

/// Signals of the cell itself.
std::vector<std::string> own_signals() {
  std::vector<std::string> names = split_choices(kChoices<coupling::Signal>);
  names.erase(names.begin());  // a concentration goes by the name of its substance
  return names;
}

void check_substance_name(const Scene& scene, const std::string& name, const std::string& pointer,
                          Report& report) {
  const std::vector<std::string> names = substance_names(scene);
  if (name.empty() || std::ranges::find(names, name) != names.end()) return;
  if (names.empty()) {
    report.add_relation({pointer, "/substances"}, "\"" + name + "\"",
                        "is no substance: the scene has none. Give a block substances");
    return;
  }
  report.add_relation(
      {pointer, "/substances"}, "\"" + name + "\"",
      "is no substance. " + did_you_mean(nearest_name(name, names),
                                         fmt::format("Known: {}", fmt::join(names, ", "))));
}

void check_substance(const Scene& scene, std::size_t k, Report& report) {
  const SubstanceBlock& s = scene.substances[k];
  const std::string pointer = fmt::format("/substances/{}", k);
  for (std::size_t other = 0; other < k; ++other)
    if (scene.substances[other].name == s.name)
      report.add_relation({pointer + "/name"}, "\"" + s.name + "\"",
                          "another substance has this name");
  const std::vector<std::string> own = own_signals();
  if (std::ranges::find(own, s.name) != own.end())
    report.add_relation({pointer + "/name"}, "\"" + s.name + "\"",
                        "is a signal of cells in rules. Take another name");
  std::set<BoxFace> sides;
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    if (!sides.insert(s.faces[f].side).second)
      report.add_relation({fmt::format("{}/faces/{}/side", pointer, f)},
                          "\"" + name_of_choice(s.faces[f].side) + "\"",
                          "another entry has this face");
  for (std::size_t f = 0; f < s.sources.size(); ++f)
    check_region(s.sources[f].region, fmt::format("{}/sources/{}/region", pointer, f), report);
  if (s.unit.empty())
    report.add_relation({pointer + "/unit"}, "\"\"", "must not be empty: \"1\" for none");
  check_course(s.course, pointer + "/course", report);
  if (s.vessels && scene.vessels.file.empty() && !scene.lobule)
    report.add_relation({pointer + "/vessels", "/vessels/file", "/lobule"}, "",
                        "needs vessels: give /vessels/file or a lobule block");
}

void check_exchange(const Scene& scene, Report& report) {
  for (const auto& [name, type] : scene.cell_types) {
    std::set<std::string> seen;
    for (std::size_t k = 0; k < type.exchange.size(); ++k) {
      const ExchangeEntry& e = type.exchange[k];
      const std::string pointer = fmt::format("/cell_types/{}/exchange/{}", name, k);
      check_substance_name(scene, e.substance, pointer + "/substance", report);
      if (!seen.insert(e.substance).second)
        report.add_relation({pointer + "/substance"}, "\"" + e.substance + "\"",
                            "another entry of this cell type has it");
    }
  }
}

/// Requires a cell type that a rule of secretion or uptake changes.
void check_exchanged(const Scene& scene, const SignalRuleEntry& r, const std::string& pointer,
                     Report& report) {
  const bool secretes = r.behaviour == coupling::Behaviour::kSecretion;
  for (const auto& [name, type] : scene.cell_types)
    for (const ExchangeEntry& e : type.exchange)
      if (e.substance == r.exchanged && (r.cell_type.empty() || r.cell_type == name) &&
          (secretes ? e.secretion > 0 || e.secretion_per_area > 0
                    : e.uptake > 0 || e.uptake_max > 0 || e.uptake_per_area > 0))
        return;
  report.add_relation(
      {pointer + "/of", "/cell_types"}, "\"" + r.exchanged + "\"",
      fmt::format("{} {} of it: the rule is a factor on that of "
                  "cell_types.<name>.exchange",
                  r.cell_type.empty() ? "no cell type has" : "cell type " + r.cell_type + " has no",
                  secretes ? "secretion" : "uptake"));
}

/// Requires a signal that is a substance or a quantity of the cell.
void check_signal(const Scene& scene, const SignalRuleEntry& r, const std::string& pointer,
                  Report& report) {
  std::vector<std::string> names = substance_names(scene);
  if (r.signal != coupling::Signal::kConcentration ||
      std::ranges::find(names, r.name) != names.end())
    return;
  for (const std::string& own : own_signals()) names.push_back(own);
  report.add_relation({pointer, "/substances"}, "\"" + r.name + "\"",
                      "is neither a substance of the scene nor a signal of the cell. " +
                          did_you_mean(nearest_name(r.name, names),
                                       fmt::format("Known: {}", fmt::join(names, ", "))));
}

void check_signal_rules(const Scene& scene, Report& report) {
  const std::vector<std::string> known = substance_names(scene);
  for (std::size_t k = 0; k < scene.rules.size(); ++k) {
    const SignalRuleEntry& r = scene.rules[k];
    const std::string pointer = fmt::format("/rules/{}", k);
    check_signal(scene, r, pointer + "/signal", report);
    check_substance_name(scene, r.exchanged, pointer + "/of", report);
    const bool exchanges = r.behaviour == coupling::Behaviour::kSecretion ||
                           r.behaviour == coupling::Behaviour::kUptake;
    const bool leads = r.behaviour == coupling::Behaviour::kChemotaxis;
    if (r.exchanged.empty() &&
        (exchanges || (leads && r.signal != coupling::Signal::kConcentration)))
      report.add_relation({pointer + "/of"}, "\"\"",
                          exchanges ? "must name the substance that is secreted or taken up"
                                    : "must name the substance whose gradient cells follow: \"" +
                                          r.name + "\" has none");
    if (exchanges && std::ranges::find(known, r.exchanged) != known.end())
      check_exchanged(scene, r, pointer, report);
    check_type_name(scene, r.cell_type, pointer + "/cell_type", report);
    check_type_name(scene, r.other, pointer + "/neighbour_type", report);
  }
}

/// A box that grows: new voxels need a concentration, and hold nothing but the medium.
void check_growing_box(const Scene& scene, Report& report) {
  const std::string grow = "/substance_grid/grow";
  std::set<BoxFace> closed;
  for (std::size_t k = 0; k < scene.substances.size(); ++k) {
    const SubstanceBlock& s = scene.substances[k];
    const std::string pointer = fmt::format("/substances/{}", k);
    for (const auto& [has, key] : {std::pair{!s.sources.empty(), "sources"},
                                   {s.vessels.has_value(), "vessels"},
                                   {s.outside_cells(), "cells"},
                                   {s.outside_obstacles, "obstacles"}})
      if (has)
        report.add_relation({grow, pointer + "/" + key}, "true",
                            fmt::format("a box that grows holds cells and medium only: leave out "
                                        "{}/{}, or give a /substance_grid/box that stays",
                                        pointer, key));
    for (int side = 0; side < 6; ++side) {
      substances::FaceKind kind = s.boundary.kind;
      for (const FaceEntry& face : s.faces)
        if (static_cast<int>(face.side) == side) kind = face.kind;
      if (kind == substances::FaceKind::kNoFlux) closed.insert(static_cast<BoxFace>(side));
    }
  }
  if (closed.size() == 6)
    report.add_relation({grow, "/substances"}, "true",
                        "no face of the box can grow: each has no_flux for a substance. Give "
                        "boundary or faces of kind fixed or exchange, with the concentration "
                        "outside");
}

void check_grid(const Scene& scene, Report& report) {
  const SubstanceGridBlock& g = scene.substance_grid;
  const std::string pointer = "/substance_grid";
  for (const auto& [name, type] : scene.cell_types)
    if (g.spacing > 2 * type.radius) {
      report.add_relation({pointer + "/spacing", "/cell_types/" + name + "/radius"},
                          quoted_length(g.spacing),
                          fmt::format("is larger than a cell of type {}, {} across: its "
                                      "surroundings would be those of its neighbours. Take at most "
                                      "that, better half of it",
                                      name, quoted_length(2 * type.radius)));
      break;
    }
  if (!g.box) return;
  for (int axis = 0; axis < 3; ++axis)
    if (!((*g.box)[0][axis] < (*g.box)[1][axis]))
      report.add_relation(
          {fmt::format("{}/box/0/{}", pointer, axis), fmt::format("{}/box/1/{}", pointer, axis)},
          quoted_length((*g.box)[0][axis]),
          fmt::format("must be below {}/box/1/{} = {}", pointer, axis,
                      quoted_length((*g.box)[1][axis])));
}

}  // namespace

void check_substances(const Scene& scene, Report& report) {
  for (std::size_t k = 0; k < scene.substances.size(); ++k) check_substance(scene, k, report);
  check_exchange(scene, report);
  check_signal_rules(scene, report);
  check_substance_name(scene, scene.motility.leader_signal, "/motility/leader_signal", report);
  if (!scene.substances.empty()) check_grid(scene, report);
  if (scene.substance_grid.grow) check_growing_box(scene, report);
}

}  // namespace acinus::runs
