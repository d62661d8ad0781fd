#pragma once
/// Named accuracies of tissue: mesh, contact points, time step and solver that belong together.

#include <string>

#include "runs/scene/fault_report.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Numerical settings whose parts of the whole error are of one size.
struct AccuracySettings {
  int nodes = 0;  ///< of a deformable cell's mesh
  contact::Quadrature quadrature = contact::Quadrature::kNodesAndEdges;
  double range = 0;      ///< mean edges, of adhesion, with these contact points
  double step = 0;       ///< s, the longest
  double tolerance = 0;  ///< um, position error of one step
  double max_move = 0;   ///< mean edges, farthest move of a node in a step
  double solver = 0;     ///< residual of the conjugate gradients, relative
  double skin = 0;       ///< um, margin of the neighbour lists
};

/// Errors to expect in tissue, relative to the finest meshes and short steps; contact forces of
/// loose tissue. Measured by `acinus bench accuracy` and `acinus bench work-precision`.
struct ExpectedErrors {
  double cytosol_pressure = 0, contact_area = 0, contact_force = 0, radius = 0;
};

/// Settings of a named accuracy.   @pre accuracy != kByKey
const AccuracySettings& settings_of(Accuracy accuracy);

/// Expected errors of a named accuracy.   @pre accuracy != kByKey
const ExpectedErrors& expected_errors(Accuracy accuracy);

/// Sets all keys of an accuracy but contact points and range of the paper's law, which keeps its
/// own.
void use_settings(const AccuracySettings& settings, Scene& scene);

/// Sets the keys that belong to the scene's accuracy and that its text does not contain. The
/// paper's law of contact keeps its own contact points and range; other contact points keep theirs.
/// @param report  of the text that the scene was read from
void apply_accuracy(const Report& report, Scene& scene);

/// Settings and expected errors of the named accuracy, and the keys of which the scene has other
/// values.   @pre scene.accuracy != kByKey
std::string describe_accuracy(const Scene& scene);

}  // namespace acinus::runs
