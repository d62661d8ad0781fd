#pragma once
/// Separation of two adhering cells by force.

#include <optional>

#include "runs/experiments/measures.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Reduced radius R1 R2 / (R1 + R2), um, and adhesion energy, nN/um, of two cells.
struct PairOfCells {
  double reduced_radius = 0, adhesion = 0;
};
/// Pair of the first two listed cells.
PairOfCells pair_of(const Scene& scene);

/// Force that parts two vesicles, nN: pi W R^. JKR is 3/2 of it, DMT 2.
/// [VanLiedekerke2020, Eq. (24)]
double vesicle_pull_off(const PairOfCells& pair);

/// Largest force that the pair bore, nN, from the series; none if it did not come apart.
std::optional<double> pull_off_force(const Measures& measures);

/// True if cells that were in contact have come apart.
bool has_come_apart(const Measures& measures);

}  // namespace acinus::runs
