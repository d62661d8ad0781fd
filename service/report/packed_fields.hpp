#pragma once
/// Fields of substances at the frames of a run, packed for slices in the 3D viewer of the page.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "io/field_file.hpp"

namespace acinus::service {

/// Grid and fields that all frames of a run share. Values are means over blocks of voxels.
struct PackedGrid {
  std::array<int, 3> n{};               ///< blocks along x, y, z; 0: no fields
  Vec3 low = Vec3::Zero();              ///< um, corner of the box with the smallest coordinates
  Vec3 size = Vec3::Zero();             ///< um, of the box
  Vec3 spacing = Vec3::Ones();          ///< um, edges of a block
  std::array<int, 3> n_voxel{};         ///< of the run
  std::vector<std::string> name, unit;  ///< [field]
  bool exists() const { return n[0] > 0; }
};

/// Grid of blocks for the fields of a frame, as fine as a limit allows.
/// @param most  numbers in all fields of a frame
PackedGrid make_packed_grid(const io::FieldFrame& frame, std::size_t most);

/// Packs a frame: per field the values of its blocks, x fastest. Blocks beyond the box of the frame
/// have the values at its faces.
/// @throws Error(kFileError) if its voxels are not among those of the grid, or its fields are
/// others
std::string pack_fields(const PackedGrid& grid, const io::FieldFrame& frame);

}  // namespace acinus::service
