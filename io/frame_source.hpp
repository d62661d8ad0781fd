#pragma once
/// Frame whose rows come in parts, so that the memory of its writer does not grow with it.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/frame.hpp"

namespace acinus::io {

/// Consecutive points with the values of all fields.
struct PointRows {
  std::span<const float> point;              ///< [n * 3] um
  std::vector<std::span<const float>> data;  ///< [field][n * components]
};

/// Consecutive triangles, or spheres.
struct CellRows {
  std::span<const std::array<std::int64_t, 3>> triangle;  ///< none: spheres
  std::span<const std::int64_t> cell_id;
  std::span<const std::uint8_t> kind;
  std::vector<std::span<const float>> data;  ///< [field][n * components]
};

/// Source of a frame: see Frame for the meaning of its parts.
struct FrameSource : FrameTables {
  double time_s = 0;
  std::int64_t n_mesh_node = 0, n_sphere = 0, n_triangle = 0;
  std::vector<Field> point_data, cell_data;  ///< without values
  /// Hands over all points in their order. Asked for once.
  std::function<void(const std::function<void(const PointRows&)>&)> points;
  /// Hands over all triangles, then all spheres. Asked for twice: what has not changed is not
  /// written again.
  std::function<void(const std::function<void(const CellRows&)>&)> surfaces;

  std::int64_t n_point() const { return n_mesh_node + n_sphere; }
  std::int64_t n_cell() const { return n_triangle + n_sphere; }
};

/// Source of a frame in one part. The frame must outlive it.
FrameSource source_of(const Frame& frame);

/// Frame with all rows of a source.
Frame collect(const FrameSource& source);

}  // namespace acinus::io
