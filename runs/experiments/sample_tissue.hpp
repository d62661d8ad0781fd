#pragma once
/// Measurements of every scene: numbers of cells, pressures, overlaps, clusters, forces on
/// walls and vessels.

#include <string>
#include <vector>

#include "contact/boundary.hpp"
#include "runs/experiments/measures.hpp"
#include "runs/experiments/observed_frame.hpp"

namespace acinus::runs {

/// Adds one number to each series of the tissue, and of each wall.
void sample_tissue(const ObservedFrame& frame, Measures& measures);

/// True if they read the points of all cells.
bool samples_points(const coupling::World& world);

/// Planes, capsules and closed meshes by the names their observables have: without characters that
/// cannot be in a name, and each once. A mesh file with several bodies is one.
std::vector<std::string> wall_names(const contact::Boundary& boundary);

}  // namespace acinus::runs
