#pragma once
/// Scene folder of an imported tissue.

#include <string>
#include <vector>

#include "imaging/import_image.hpp"
#include "runs/scene/choices.hpp"

namespace acinus::runs {

/// Options of the scene of an imported tissue.
struct TissueScene {
  CellModel model = CellModel::kDcm;
  int nodes = 162;  ///< nodes of a deformable cell's mesh
};

/// Writes scene.json, cells.vtk and cells.csv into a new folder, and vessels.vtk and left_out.csv
/// if the tissue has vessels or labels without a cell. The scene is read back as a check.
/// @param options  of the import; recorded in the scene
/// @return paths written, the scene first
/// @throws Error if the folder exists (kBadInput) or cannot be written (kFileError)
std::vector<std::string> write_tissue(const imaging::ImportedTissue& tissue,
                                      const imaging::ImportOptions& options,
                                      const TissueScene& scene, const std::string& folder);

}  // namespace acinus::runs
