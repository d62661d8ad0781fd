#include "runs/scene/accuracy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>
#include <vector>

namespace acinus::runs {
namespace {

using contact::Quadrature;

struct NamedAccuracy {
  AccuracySettings settings;
  ExpectedErrors errors;
};

constexpr std::array<NamedAccuracy, 3> kNamed{{
    {{162, Quadrature::kNodesAndEdges, 0.5, 300, 0.3, 0.6, 0.05, 0.6}, {0.11, 0.17, 0.65, 0.04}},
    {{362, Quadrature::kNodes, 0.5, 120, 0.15, 0.6, 0.02, 0.6}, {0.11, 0.06, 0.79, 0.02}},
    {{642, Quadrature::kNodesAndEdges, 0.35, 60, 0.05, 0.6, 0.01, 0.3}, {0.06, 0.03, 0.32, 0.02}},
}};

const NamedAccuracy& named(Accuracy accuracy) {
  return kNamed[static_cast<std::size_t>(accuracy) - 1];
}

/// Calls visit(pointer, field, value) for every key of an accuracy.
template <class AnyScene, class F>
void for_each_key(const AccuracySettings& a, AnyScene& scene, const F& visit) {
  visit("/time/step", scene.numerics.max_step, a.step);
  visit("/time/tolerance", scene.numerics.tolerance, a.tolerance);
  visit("/time/max_move", scene.numerics.max_move, a.max_move);
  visit("/solver/tolerance", scene.numerics.cg.tolerance, a.solver);
  visit("/contact/skin", scene.contact.skin, a.skin);
  if (scene.contact.law == dcm::ContactLaw::kCohesive) {
    visit("/contact/quadrature", scene.contact.quadrature, a.quadrature);
    if (scene.contact.quadrature == a.quadrature)
      visit("/contact/range", scene.contact.range_factor, a.range);
  }
  for (auto& [name, type] : scene.cell_types)
    visit("/cell_types/" + name + "/dcm/nodes", type.dcm.nodes, a.nodes);
}

}  // namespace

const AccuracySettings& settings_of(Accuracy accuracy) { return named(accuracy).settings; }

const ExpectedErrors& expected_errors(Accuracy accuracy) { return named(accuracy).errors; }

void use_settings(const AccuracySettings& settings, Scene& scene) {
  for_each_key(settings, scene,
               [](const std::string&, auto& field, const auto& value) { field = value; });
}

void apply_accuracy(const Report& report, Scene& scene) {
  if (scene.accuracy == Accuracy::kByKey) return;
  for_each_key(settings_of(scene.accuracy), scene,
               [&](const std::string& pointer, auto& field, const auto& value) {
                 if (report.find(pointer) == nullptr) field = value;
               });
}

std::string describe_accuracy(const Scene& scene) {
  const AccuracySettings& a = settings_of(scene.accuracy);
  const ExpectedErrors& e = expected_errors(scene.accuracy);
  std::vector<std::string> other;
  for_each_key(a, scene, [&](const std::string& pointer, const auto& field, const auto& value) {
    if (field != value) other.push_back(pointer);
  });
  return fmt::format(
      "accuracy {}: {} nodes a cell, contact points {} with a range of {:g} edges, steps to "
      "{:g} s of {:g} um each; expected errors in tissue: cytosol pressure {:.0f} %, radius of the "
      "tissue {:.0f} %, contact area {:.0f} %, contact force {:.0f} %{}",
      name_of_choice(scene.accuracy), a.nodes, name_of_choice(a.quadrature), a.range, a.step,
      a.tolerance, 100 * e.cytosol_pressure, 100 * e.radius, 100 * e.contact_area,
      100 * e.contact_force,
      other.empty()
          ? ""
          : fmt::format(". The scene has other values of {}, so its errors are other ones",
                        fmt::join(other, ", ")));
}

}  // namespace acinus::runs
