#include "tests/fuzz/targets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "geometry/readers/read_network.hpp"
#include "geometry/readers/read_surface.hpp"
#include "imaging/read_image.hpp"
#include "imaging/write_image.hpp"
#include "io/checkpoint.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/study/read_study.hpp"
#include "service/serve/submission.hpp"
#include "tests/imaging/hdf5_dataset.hpp"
#include "tests/imaging/images.hpp"
#include "tests/imaging/zarr_folder.hpp"
#include "tests/io/sample.hpp"
#include "tests/paths.hpp"

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
  copy_all(test::source_path("runs/scenes"), ".json", folder);
}

/// Check of an accepted file: acinus must be able to go on with the result.
void must(bool sound, const char* what) {
  if (!sound) throw std::logic_error(std::string("accepted: ") + what);
}

bool are_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

void read_law(const std::string& path) {
  const calibration::Law law = calibration::read_law(path);
  must(are_finite(std::array{law.a0, law.a1, law.power, law.wall_recess}) && law.a0 > 0,
       "a law with no finite modulus");
  for (const calibration::TableEntry& entry : law.table)
    must(std::isfinite(entry.overlap) && std::isfinite(entry.modulus), "a law with NaN");
}
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

void read_network(const std::string& path) {
  const geometry::Network network = geometry::read_network(path);
  for (const Vec3& node : network.node) must(node.allFinite(), "a node that is nowhere");
  for (const auto& [a, b] : network.segment)
    must(std::min(a, b) >= 0 && std::max(a, b) < static_cast<int>(network.node.size()),
         "a segment without nodes");
  for (const auto& [a, b] : network.radius)
    must(a > 0 && b > 0 && std::isfinite(a + b), "a vessel without a radius");
}

void read_surface(const std::string& path) {
  for (const geometry::Surface& body : geometry::read_closed_surfaces(path, 1)) {
    for (const Vec3& node : body.node) must(node.allFinite(), "a node that is nowhere");
    for (const auto& face : body.triangle)
      for (const int node : face)
        must(node >= 0 && node < static_cast<int>(body.node.size()), "a triangle without nodes");
  }
}

void read_image(const std::string& path) {
  const imaging::LabelRows image = imaging::read_image(path, {.voxel = Vec3(1, 1, 1)});
  const auto& [x, y, z] = image.size;
  must(x > 0 && y > 0 && z > 0 && image.line.size() == static_cast<std::size_t>(y) * z,
       "an image of another size");
  for (const imaging::LabelLine& line : image.line)
    must(!line.empty() && line.back().end == x, "a line that ends early");
  must(image.voxel.allFinite() && image.voxel.minCoeff() > 0, "voxels without a size");
}
imaging::LabelImage make_labels() {
  imaging::LabelImage image;
  image.size = {6, 5, 4};
  image.voxel = Vec3(0.5, 0.5, 1);
  for (imaging::Label k = 0; k < 6 * 5 * 4; ++k) image.label.push_back(k / 7 * 300);
  return image;
}
void write_tiff(const std::string& folder) {
  imaging::write_image(folder + "/image.tif", make_labels());
}
void write_nrrd(const std::string& folder) {
  imaging::write_image(folder + "/image.nrrd", make_labels());
}
void write_metaimage(const std::string& folder) {
  imaging::write_image(folder + "/image.mha", make_labels());
}
void write_nifti(const std::string& folder) {
  constexpr std::int16_t kMicrons = 3;
  std::ofstream(folder + "/image.nii", std::ios::binary) << imaging::nifti(make_labels(), kMicrons);
}
void write_hdf5_image(const std::string& folder) {
  imaging::write_dataset(folder + "/plain.h5",
                         {.shape = {4, 5, 6}, .value = make_labels().label, .step = {1, 0.5, 0.5}});
  imaging::write_dataset(folder + "/named.h5", {.shape = {4, 5, 6},
                                                .value = make_labels().label,
                                                .labels = {"z", "y", "x"},
                                                .step = {1, 0.5, 0.5},
                                                .chunk = {2, 5, 6}});
}
const imaging::ZarrForm kShards{.chunk = {4, 4, 8}, .inner = {2, 2, 4}, .codec = "blosc"};
const std::string kShardFile = "/0/c/0/0/0";

/// Reads bytes as the metadata of an array, or else as a shard, within a folder of OME-Zarr.
void read_zarr_part(const std::string& path) {
  const std::string folder = path + ".zarr";
  imaging::write_zarr(folder, make_labels(), kShards);
  const bool metadata = std::ifstream(path).peek() == '{';
  fs::copy_file(path, folder + (metadata ? "/0/zarr.json" : kShardFile),
                fs::copy_options::overwrite_existing);
  read_image(folder);
}
void write_zarr_parts(const std::string& folder) {
  const std::string whole = folder + "/whole.zarr";
  imaging::write_zarr(whole, make_labels(), kShards);
  fs::copy_file(whole + "/0/zarr.json", folder + "/array.json");
  fs::copy_file(whole + kShardFile, folder + "/shard.json");
  fs::remove_all(whole);
}
void write_vtk(const std::string& folder) { copy_all(test::data_path("files"), ".vtk", folder); }

io::CheckpointData make_state() {
  io::CheckpointData data;
  data.put("dcm/position", std::vector<double>(300, 1.5));
  data.put("cell/lineage", std::vector<std::int64_t>{1, 2, 3});
  data.put_number("time", 60);
  return data;
}
void read_checkpoint(const std::string& path) {
  must(io::load_state_file(path).all() == make_state().all(), "a state that nobody wrote");
}
void write_checkpoints(const std::string& folder) {
  io::save_state_file(folder + "/state.h5", io::CheckpointSource(make_state()));
}

void read_run_file(const std::string& path) {
  const io::RunReader reader(path);
  for (int k = 0; k < reader.n_frame(); ++k) {
    const io::Frame frame = reader.frame(k);
    must(std::ranges::all_of(frame.point, [](float v) { return std::isfinite(v); }),
         "a point that is nowhere");
    for (const auto& face : frame.triangle)
      for (const std::int64_t node : face)
        must(node >= 0 && node < frame.n_mesh_node, "a triangle without nodes");
  }
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

void read_study(const std::string& path) {
  must(!runs::read_study(path).runs.empty(), "a study without runs");
}
void write_studies(const std::string& folder) {
  copy_all(test::source_path("runs/studies"), ".json", folder);
}

/// Fresh folder beside a file that holds it under another name.
std::string folder_with(const std::string& path, const std::string& name) {
  const std::string folder = fs::path(path).replace_extension(".folder").string();
  fs::remove_all(folder);
  fs::create_directory(folder);
  fs::copy_file(path, folder + "/" + name);
  return folder;
}

void read_summary(const std::string& path) {
  const runs::RunSummary summary = runs::read_summary(folder_with(path, "summary.json"));
  must(are_finite(std::array{summary.simulated_s, summary.wall_s, summary.cpu_s}) &&
           summary.dcm >= 0 && summary.cbm >= 0,
       "a summary without numbers");
}
void write_summaries(const std::string& folder) {
  std::ofstream(folder + "/summary.json")
      << R"({"scene": "a", "scene_hash": "0", "version": "1", "git": "b", "status": "completed",
             "cause": "", "state_hash": "c", "start": {"state_hash": "d"}, "simulated_s": 1,
             "wall_s": 2, "cpu_s": 3, "cells": {"dcm": 1, "cbm": 2},
             "measures": {"time_s": [0, 1, null], "wall_s_at_cells": {"10": 1}}})";
}

void read_submission(const std::string& path) {
  service::ServeOptions options;
  options.max_cells = 50;
  options.max_memory = 1e9;
  service::prepare_submission(folder_with(path, service::kRequestFile), options);
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
      {"image_tiff", {".tif"}, read_image, write_tiff},
      {"image_nifti", {".nii"}, read_image, write_nifti},
      {"image_nrrd", {".nrrd"}, read_image, write_nrrd},
      {"image_meta", {".mha"}, read_image, write_metaimage},
      {"image_hdf5", {".h5"}, read_image, write_hdf5_image, true},
      {"image_zarr", {".json"}, read_zarr_part, write_zarr_parts, true},
      {"checkpoint", {".h5"}, read_checkpoint, write_checkpoints, true},
      {"run_file", {".vtkhdf"}, read_run_file, write_run_files, true},
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
