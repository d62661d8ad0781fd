#pragma once
/// Measured series of every written frame by name: the columns of /observables in the run file.

#include <cstddef>
#include <string>
#include <vector>

#include "runs/experiments/observable.hpp"
#include "runs/scene/experiment_list.hpp"

namespace acinus::runs {

/// Observables of a scene with this experiment besides those of its walls, in the order of the
/// columns. `time` (s since t = 0), which every run file has, is not among them.
std::vector<Observable> known_observables(Experiment experiment);

/// Name of a scene as part of a column's name: letters, digits, '-', '.' and '_'.
std::string name_in_columns(std::string name);

/// Observables of a substance of this name, with its unit of concentration.
std::vector<Observable> substance_observables(const std::string& name, const std::string& unit);

/// Observables of the rule of this number in the scene.
std::vector<Observable> rule_observables(std::size_t rule);

/// Observables of a wall, capsule or closed mesh of this name.
std::vector<Observable> wall_observables(const std::string& wall);

}  // namespace acinus::runs
