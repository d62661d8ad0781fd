#include "runs/experiments/read_scene.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/checkpoint.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/scene/accuracy.hpp"
#include "runs/scene/key_reader.hpp"
#include "runs/scene/registry.hpp"
#include "runs/scene/scene_rules.hpp"
#include "runs/scene/writer.hpp"

namespace acinus::runs {
namespace {
namespace fs = std::filesystem;

void name_the_nameless(Scene& scene) {
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (scene.walls[i].name.empty()) scene.walls[i].name = fmt::format("wall{}", i);
  }
  for (std::size_t i = 0; i < scene.static_meshes.size(); ++i) {
    StaticMeshEntry& mesh = scene.static_meshes[i];
    if (mesh.name.empty()) mesh.name = fmt::format("mesh{}", i);
  }
  if (scene.cell_types.size() == 1) {
    for (CellEntry& cell : scene.cells.list) {
      if (cell.type.empty()) cell.type = scene.cell_types.begin()->first;
    }
  }
}

/// Hash of the state at t = 0 that a run left in its folder for others to start from.
/// @throws Error (kFileError) if its start.h5 cannot be read
std::string read_start_hash(const std::string& run_folder) {
  return io::load_state_file(run_folder + "/start.h5").text("state_hash");
}

/// Refuses cells.model from the command line where `model` of the scene stands in its place.
void check_model_flag(const Document& document, const Scene& scene, Report& report) {
  const Node* node = report.find("/cells/model");
  if (!scene.model || node == nullptr || !document.sources[node->origin.source].is_flag) return;
  if (!scene.cells.model || scene.cells.model == scene.model) return;
  const std::string wanted = name_of_choice(*scene.cells.model);
  report.add_relation({"/cells/model", "/model"}, "\"" + wanted + "\"",
                      fmt::format("has no effect, since /model = \"{}\" stands in its place. Take "
                                  "--set model={}",
                                  name_of_choice(*scene.model), wanted));
}

}  // namespace

Scene read_scene(const Document& document, const std::string& label) {
  Scene scene;
  Report report(document);
  read_keys(document, report, [&scene](Visitor& visitor) { describe(visitor, scene); });
  apply_accuracy(report, scene);
  if (scene.name.empty()) scene.name = default_name(label);
  check_model_flag(document, scene, report);
  scene.cells.model = model_of(scene);
  name_the_nameless(scene);
  check_rules(scene, report, experiment_row(scene.experiment).check);
  report.finish();
  scene.file = label;
  if (!scene.start_up.from.empty()) scene.start_state = read_start_hash(scene.start_up.from);
  set_canonical(scene);
  return scene;
}

Scene read_scene(const std::string& path, const std::vector<std::string>& set) {
  Document document = read_document(path);
  for (const std::string& assignment : set) apply_set(document, assignment);
  return read_scene(document, path);
}

Scene parse_scene(const std::string& text, const std::string& label, const std::string& folder,
                  const std::vector<std::string>& set) {
  Document document = parse_document(text, label, folder);
  for (const std::string& assignment : set) apply_set(document, assignment);
  return read_scene(document, label);
}

}  // namespace acinus::runs
