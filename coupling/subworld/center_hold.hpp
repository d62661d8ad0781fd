#pragma once
/// Device that keeps the centres of deformable cells in place while their shapes come to rest.

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/vec.hpp"
#include "coupling/apparatus/device.hpp"

namespace acinus::coupling {

/// Place of the centroid of a cell's volume.
struct HeldCentroid {
  std::int64_t cell = 0;  ///< lineage
  Vec3 centroid = Vec3::Zero();
};

/// Stiff springs between the centroids of the volumes of cells and fixed points: energy
/// k/2 |c - c0|^2, stiffness k dc/dx dc/dx^T.
struct CenterHold final : Device {
  std::vector<HeldCentroid> held;

  explicit CenterHold(std::vector<HeldCentroid> cells) : held(std::move(cells)) {}

  double next_change(double) const override { return std::numeric_limits<double>::infinity(); }
  void add_loads(double time, const LoadedCells& cells,
                 std::span<solve::RankOne> own) const override;
  std::size_t count_rank_one() const override { return 3; }
};

}  // namespace acinus::coupling
