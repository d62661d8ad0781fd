#pragma once
/// What runs measure at every written frame, by name: the columns of /observables in the run file.

#include <string>
#include <vector>

#include "runs/scene/choices.hpp"

namespace acinus::runs {

struct Observable {
  std::string name;     ///< ends in its unit where there is one
  std::string unit;     ///< of the values, "1" if there is none
  std::string meaning;  ///< one line
};

/// Everything a scene with this `experiment` measures besides the walls it has, in the order of the
/// columns. `time` (s since t = 0), which every run file has, is not among them.
std::vector<Observable> known_observables(Experiment experiment);

/// A name of a scene as columns bear it: letters, digits, '-', '.' and '_'.
std::string name_in_columns(std::string name);

/// What is measured of a wall, capsule or closed mesh of this name.
std::vector<Observable> wall_observables(const std::string& wall);

}  // namespace acinus::runs
