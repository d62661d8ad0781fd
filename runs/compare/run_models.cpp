#include "runs/compare/compare.hpp"
#include "runs/scene/writer.hpp"
#include "runs/session/stage.hpp"

namespace acinus::runs {

int run_models(const Scene& scene, const CompareScenes& options,
               std::vector<std::string>& folders) {
  struct Model {
    const char* folder;
    CellModel model;
    bool corrected;
  };
  std::vector<Model> models{{"dcm", CellModel::kDcm, false}, {"cbm", CellModel::kCbm, false}};
  if (!options.law.empty()) models.push_back({"cbm_calibrated", CellModel::kCbm, true});
  for (const Model& m : models) {
    Scene s = scene;
    s.model = s.cells.model = m.model;
    for (auto& [name, type] : s.cell_types) {
      type.cbm.stiffness_correction = m.corrected ? options.law : "none";
      if (options.equal_drag) type.cbm.medium_friction = type.dcm.medium_friction;
    }
    if (options.equal_drag) {
      if (!m.corrected) s.friction.cbm_cbm = s.contact.cell_friction;
      s.friction.cbm_vessel = s.friction.dcm_vessel;
    }
    set_canonical(s);
    const std::string folder = options.folder + "/" + m.folder;
    folders.push_back(folder);
    // The law's file may hold another law than it did; its name is all that a scene's hash knows.
    if (const int stop = run_stage(
            s, {folder, options.threads, options.quiet, m.corrected, options.command_line}))
      return stop;
  }
  return 0;
}

}  // namespace acinus::runs
