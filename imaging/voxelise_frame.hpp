#pragma once
/// Cells of a frame of a run file as surfaces, and as a label image.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/surface.hpp"
#include "imaging/label_image.hpp"
#include "imaging/voxelise.hpp"
#include "io/frame.hpp"

namespace acinus::imaging {

using CellSurfaces = std::map<std::int64_t, geometry::Surface>;  ///< keyed by lineage

/// Closed surfaces of all cells of a frame, um: meshes as they are, spheres as icospheres.
CellSurfaces frame_surfaces(const io::Frame& frame);

/// Label and measures of one cell of the image.
struct LabelledCell {
  Label label = 0;
  std::int64_t lineage = 0;
  double volume = 0;           ///< volume of its mesh or sphere, um^3
  Vec3 center = Vec3::Zero();  ///< centroid, um from the corner of the image
};

struct CellImage {
  LabelImage image;
  std::vector<LabelledCell> cell;  ///< ascending labels and lineages
  Label vessels = 0;               ///< label of the vessels; 0 = none
};

/// Voxelises cells with labels from 1, and vessels with the label after the last cell.
/// @param vessels  closed surface of all vessels; empty = none
/// @throws Error for too many voxels
CellImage voxelise_cells(CellSurfaces cells, std::optional<geometry::Surface> vessels,
                         const Voxelise& how);

/// CSV table with a row per cell: label,cell,volume_um3,x_um,y_um,z_um.
std::string labels_text(const CellImage& image);

}  // namespace acinus::imaging
