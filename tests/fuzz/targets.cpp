#include "tests/fuzz/targets.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "core/image/read_image.hpp"
#include "core/image/write_image.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/run_file.hpp"
#include "core/io/run_reader.hpp"
#include "core/mesh/read_network.hpp"
#include "core/mesh/read_surface.hpp"
#include "runs/scene/reader.hpp"
#include "runs/serve/submission.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/study/plan.hpp"
#include "tests/core/image/images.hpp"
#include "tests/core/io/sample.hpp"

namespace acinus::fuzz {
namespace {

namespace fs = std::filesystem;

void copy_all(const fs::path& from, const std::string& ending, const std::string& to) {
  for (const auto& entry : fs::directory_iterator(from))
    if (entry.path().extension() == ending)
      fs::copy_file(entry.path(), fs::path(to) / entry.path().filename(),
                    fs::copy_options::overwrite_existing);
}

void read_scene(const std::string& path) {
  const runs::Scene scene = runs::read_scene(path);
  // What a run writes down must be the scene it ran.
  const runs::Scene again =
      runs::parse_scene(scene.resolved_json, path, fs::path(path).parent_path().string());
  if (again.hash != scene.hash) throw std::logic_error("the resolved scene is another one");
}
void write_scenes(const std::string& folder) {
  copy_all(ACINUS_SOURCE_DIR "/runs/scenes", ".json", folder);
}

void read_law(const std::string& path) { calibration::read_law(path); }
void write_laws(const std::string& folder) {
  calibration::Law law;
  law.a0 = 0.4;
  law.a1 = 2;
  law.power = 3;
  law.overlap_range = {0, 0.1};
  law.a1_interval = {1, 3};
  law.r_squared = 0.99;
  calibration::write_law(law, folder + "/law.json");
}

void read_network(const std::string& path) { mesh::read_network(path); }
void read_surface(const std::string& path) { mesh::read_closed_surfaces(path, 1); }
void read_image(const std::string& path) { image::read_image(path, {.voxel = Vec3(1, 1, 1)}); }
void write_images(const std::string& folder) {
  image::LabelImage image;
  image.size = {6, 5, 4};
  image.voxel = Vec3(0.5, 0.5, 1);
  for (image::Label k = 0; k < 6 * 5 * 4; ++k) image.label.push_back(k / 7 * 300);
  for (const char* name : {"/image.tif", "/image.mha", "/image.nrrd"})
    image::write_image(folder + name, image);
  constexpr std::int16_t kMicrons = 3;
  std::ofstream(folder + "/image.nii", std::ios::binary) << image::nifti(image, kMicrons);
}
void write_vtk(const std::string& folder) { copy_all(ACINUS_TEST_DATA "/files", ".vtk", folder); }

void read_checkpoint(const std::string& path) { io::load_state_file(path); }
void write_checkpoints(const std::string& folder) {
  io::CheckpointData data;
  data.put("dcm/position", std::vector<double>(300, 1.5));
  data.put("cell/lineage", std::vector<std::int64_t>{1, 2, 3});
  data.put_number("time", 60);
  io::save_state_file(folder + "/state.h5", data);
}

void read_run_file(const std::string& path) {
  const io::RunReader reader(path);
  for (int k = 0; k < reader.n_frame(); ++k) reader.frame(k);
  reader.series();
  reader.observables();
  reader.events();
  reader.provenance();
}
void write_run_files(const std::string& folder) {
  io::RunFile run = io::RunFile::create(folder + "/run.vtkhdf", {{"seed", "1"}});
  for (int k = 0; k < 2; ++k) {
    run.append(io::test::make_frame(k, 1, 1));
    run.append_event({60.0 * k, "note", {k}, "event"});
  }
  run.close();
}

void read_study(const std::string& path) { runs::read_study(path); }
void write_studies(const std::string& folder) {
  copy_all(ACINUS_SOURCE_DIR "/runs/studies", ".json", folder);
}

/// A fresh folder beside a file that holds it under another name.
std::string folder_with(const std::string& path, const std::string& name) {
  const std::string folder = fs::path(path).replace_extension(".folder").string();
  fs::remove_all(folder);
  fs::create_directory(folder);
  fs::copy_file(path, folder + "/" + name);
  return folder;
}

void read_summary(const std::string& path) {
  runs::read_summary(folder_with(path, "summary.json"));
}
void write_summaries(const std::string& folder) {
  std::ofstream(folder + "/summary.json")
      << R"({"scene": "a", "scene_hash": "0", "version": "1", "git": "b", "status": "completed",
             "cause": "", "state_hash": "c", "start": {"state_hash": "d"}, "simulated_s": 1,
             "wall_s": 2, "cpu_s": 3, "cells": {"dcm": 1, "cbm": 2},
             "measures": {"time_s": [0, 1, null], "wall_s_at_cells": {"10": 1}}})";
}

void read_submission(const std::string& path) {
  runs::ServeOptions options;
  options.max_cells = 50;
  options.max_memory = 1e9;
  runs::prepare_submission(folder_with(path, runs::kRequestFile), options);
}
void write_submissions(const std::string& folder) {
  std::ofstream(folder + "/shipped.json")
      << R"({"scene": "two_cells", "set": {"time.end": "2 h"}, "name": "a"})";
  std::ofstream(folder + "/own.json")
      << R"({"scene": {"extends": "two_cells", "time": {"end": "1 h"}, "static_meshes":
             [{"name": "w", "file": "w.obj"}]}, "files": {"w.obj": "diAwIDAgMAp2IDEgMCAwCg=="}})";
}

const std::vector<Target>& all_targets() {
  static const std::vector<Target> all{
      {"scene", {".json"}, read_scene, write_scenes},
      {"law", {".json"}, read_law, write_laws},
      {"network", {".vtk", ".swc", ".vmv"}, read_network, write_vtk},
      {"surface", {".vtk", ".obj", ".stl", ".ply"}, read_surface, write_vtk},
      {"image", {".tif", ".nii", ".mha", ".nrrd"}, read_image, write_images},
      {"checkpoint", {".h5"}, read_checkpoint, write_checkpoints},
      {"run_file", {".vtkhdf"}, read_run_file, write_run_files},
      {"study", {".json"}, read_study, write_studies},
      {"summary", {".json"}, read_summary, write_summaries},
      {"submission", {".json"}, read_submission, write_submissions}};
  return all;
}

}  // namespace

std::span<const Target> targets() { return all_targets(); }

const Target& find_target(const std::string& name) {
  std::string known;
  for (const Target& target : all_targets()) {
    if (target.name == name) return target;
    known += " " + target.name;
  }
  throw std::invalid_argument("no target " + name + "; there are:" + known);
}

bool try_bytes(const Target& target, const std::string& folder, std::span<const char> bytes) {
  bool accepted = false;
  for (const std::string& ending : target.endings) {
    const std::string path = folder + "/input" + ending;
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    try {
      target.read(path);
      accepted = true;
    } catch (const Error& error) {
      if (std::string(error.what()).empty()) throw std::logic_error("an error that says nothing");
      if (error.code() == Exit::kInternal) throw std::logic_error(error.what());
    }
  }
  return accepted;
}

}  // namespace acinus::fuzz
