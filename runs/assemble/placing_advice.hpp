#pragma once
/// What to change in a scene whose cells start too near to each other.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Ways to start the cells of a scene small or just born, as it may be.   @pre no start-up
std::vector<std::string> ways_to_start_smaller(const Scene& scene);

/// How the cells of a scene come to stand farther apart.
std::string way_to_part(const Scene& scene);

}  // namespace acinus::runs
