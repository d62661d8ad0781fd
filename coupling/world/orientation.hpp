#pragma once
/// Default orientation of the mesh of a cell.

#include <cstdint>

#include "core/numbers/random.hpp"
#include "core/vec.hpp"

namespace acinus::coupling {

/// Rotation drawn uniformly from all, reproducible per seed and lineage.
inline Mat3 random_orientation(std::uint64_t seed, std::int64_t lineage) {
  UniformStream r(seed, Purpose::kPlacement, static_cast<std::uint64_t>(lineage) + 1);
  Eigen::Quaterniond q(r.normal(), r.normal(), r.normal(), r.normal());
  return q.normalized().toRotationMatrix();
}

}  // namespace acinus::coupling
