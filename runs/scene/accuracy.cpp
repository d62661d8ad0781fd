#include "runs/scene/accuracy.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace acinus::runs {
namespace {

using contact::Quadrature;

struct NamedAccuracy {
  AccuracySettings settings;
  ExpectedErrors errors;
};

constexpr std::array<NamedAccuracy, 3> kNamed{{
    {{162, Quadrature::kNodesAndEdges, 300, 0.3, 0.6, 0.05, 0.6}, {0.10, 0.13, 0.5, 0.04}},
    {{362, Quadrature::kNodes, 120, 0.15, 0.6, 0.02, 0.6}, {0.05, 0.06, 0.3, 0.02}},
    {{642, Quadrature::kNodesAndEdges, 60, 0.05, 0.6, 0.01, 0.3}, {0.03, 0.03, 0.15, 0.01}},
}};

const NamedAccuracy& named(Accuracy accuracy) {
  return kNamed[static_cast<std::size_t>(accuracy) - 1];
}

/// Sets the keys of an accuracy whose pointers `may_set` accepts.
template <class F>
void set_where(const AccuracySettings& a, Scene& scene, const F& may_set) {
  const auto set = [&may_set](const std::string& pointer, auto& field, const auto& value) {
    if (may_set(pointer)) field = value;
  };
  set("/time/step", scene.numerics.max_step, a.step);
  set("/time/tolerance", scene.numerics.tolerance, a.tolerance);
  set("/time/max_move", scene.numerics.max_move, a.max_move);
  set("/solver/tolerance", scene.numerics.cg.tolerance, a.solver);
  set("/contact/skin", scene.contact.skin, a.skin);
  if (scene.contact.law == dcm::ContactLaw::kCohesive)
    set("/contact/quadrature", scene.contact.quadrature, a.quadrature);
  for (auto& [name, type] : scene.cell_types)
    set("/cell_types/" + name + "/dcm/nodes", type.dcm.nodes, a.nodes);
}

}  // namespace

const AccuracySettings& settings_of(Accuracy accuracy) { return named(accuracy).settings; }

const ExpectedErrors& expected_errors(Accuracy accuracy) { return named(accuracy).errors; }

void use_settings(const AccuracySettings& settings, Scene& scene) {
  set_where(settings, scene, [](const std::string&) { return true; });
}

void apply_accuracy(const Report& report, Scene& scene) {
  if (scene.accuracy == Accuracy::kByKey) return;
  set_where(settings_of(scene.accuracy), scene,
            [&](const std::string& pointer) { return report.find(pointer) == nullptr; });
}

std::string describe_accuracy(const Scene& scene) {
  const AccuracySettings& a = settings_of(scene.accuracy);
  const ExpectedErrors& e = expected_errors(scene.accuracy);
  return fmt::format(
      "accuracy {}: {} nodes a cell, contact points {}, steps to {:g} s of {:g} um each; expected "
      "errors in tissue: cytosol pressure {:.0f} %, radius of the tissue {:.0f} %, contact area "
      "{:.0f} %, contact force {:.0f} %",
      name_of_choice(scene.accuracy), a.nodes, name_of_choice(a.quadrature), a.step, a.tolerance,
      100 * e.cytosol_pressure, 100 * e.radius, 100 * e.contact_area, 100 * e.contact_force);
}

}  // namespace acinus::runs
