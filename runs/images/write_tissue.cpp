#include "runs/images/write_tissue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "io/disk.hpp"
#include "io/surface_file.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/json_text.hpp"
#include "runs/scene/key_reader.hpp"

namespace acinus::runs {
namespace {

using imaging::ImportedCell, imaging::ImportedTissue, imaging::ImportOptions, imaging::LeftOut;

constexpr const char *kScene = "scene.json", *kCells = "cells.vtk", *kVessels = "vessels.vtk",
                     *kTable = "cells.csv", *kLeftOut = "left_out.csv";

/// Quoted length with unit for a scene file, six significant digits.
std::string length(double um) { return fmt::format("\"{:.6g} um\"", um); }

std::string quoted(const std::string& text) { return nlohmann::json(as_utf8(text)).dump(); }

/// Guard that removes a folder unless it was finished.
struct UnfinishedFolder {
  std::string folder;
  bool finished = false;
  ~UnfinishedFolder() {
    std::error_code ignored;
    if (!finished) std::filesystem::remove_all(folder, ignored);
  }
};

double mean_radius(const ImportedTissue& t) {
  double volume = 0;
  for (const ImportedCell& c : t.cell) volume += c.volume;
  return sphere_radius(volume / static_cast<double>(t.cell.size()));
}

/// Scene text of mirror walls at the image borders that cut cells: the tissue continues there.
std::string walls_text(const ImportedTissue& t) {
  constexpr std::array<const char*, 3> kAxis{"x", "y", "z"};
  std::array<std::array<bool, 2>, 3> cut{};
  Vec3 extent;
  for (std::size_t k = 0; k < 3; ++k) extent[k] = t.size[k] * t.voxel[k];
  for (const ImportedCell& c : t.cell) {
    if (!c.at_border) continue;
    for (const Vec3& x : c.surface.node)
      for (std::size_t k = 0; k < 3; ++k) {
        cut[k][0] = cut[k][0] || x[k] < t.voxel[k];
        cut[k][1] = cut[k][1] || x[k] > extent[k] - t.voxel[k];
      }
  }
  std::vector<std::string> walls;
  for (std::size_t k = 0; k < 3; ++k)
    for (const bool high : {false, true}) {
      if (!cut[k][high ? 1 : 0]) continue;
      std::array<std::string, 3> point{length(0), length(0), length(0)};
      std::array<int, 3> normal{};
      point[k] = length(high ? extent[k] : 0);
      normal[k] = high ? -1 : 1;
      walls.push_back(fmt::format(
          "    {{ \"name\": \"{}_{}\", \"point\": [{}], \"normal\": [{}], "
          "\"mirror\": true }}",
          high ? "high" : "low", kAxis[k], fmt::join(point, ", "), fmt::join(normal, ", ")));
    }
  return walls.empty() ? "" : fmt::format("  \"walls\": [\n{}\n  ],\n", fmt::join(walls, ",\n"));
}

/// Scene text of a zoom: deformable cells within a ball of a third of the tissue's extent.
std::string zoom_text(const ImportedTissue& t) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const ImportedCell& c : t.cell) {
    low = low.cwiseMin(c.center);
    high = high.cwiseMax(c.center);
  }
  const Vec3 middle = 0.5 * (low + high);
  const double radius = std::max((high - low).maxCoeff() / 3, mean_radius(t));
  return fmt::format(
      "  \"zoom\": [{{ \"kind\": \"sphere\", \"center\": [{}, {}, {}], \"radius\": {} }}],\n",
      length(middle[0]), length(middle[1]), length(middle[2]), length(radius));
}

std::string scene_text(const ImportedTissue& t, const std::string& image_file,
                       const TissueScene& tissue, const std::string& name) {
  const std::string image = std::filesystem::path(image_file).filename().string();
  const std::string vessels =
      t.vessel.empty()
          ? ""
          : fmt::format("  \"static_meshes\": [{{ \"name\": \"vessels\", \"file\": \"{}\" }}],\n",
                        kVessels);
  return fmt::format(
      R"({{
  // {} cells of a label image of {} x {} x {} voxels, {:.4g} x {:.4g} x {:.4g} um each. Lengths are
  // from the corner of the image. {} says which cell has which label.
  "name": {},
  "description": {},
  "model": "{}",
  "time": {{ "end": "1 h", "step": "60 s" }},
  // The radius is the mean of all; every cell has the volume of its own surface.
  "cell_types": {{ "cell": {{ "radius": {}, "dcm": {{ "nodes": {} }} }} }},
  "cells": {{ "source": "meshes", "file": "{}" }},
{}{}{}  "output": {{ "every": "10 min" }}
}}
)",
      t.cell.size(), t.size[0], t.size[1], t.size[2], t.voxel[0], t.voxel[1], t.voxel[2], kTable,
      quoted(name), quoted(fmt::format("{} cells from the image {}", t.cell.size(), image)),
      name_of_choice(tissue.model), length(mean_radius(t)), tissue.nodes, kCells,
      tissue.model == CellModel::kZoom ? zoom_text(t) : "", vessels, walls_text(t));
}

std::string cells_text(const ImportedTissue& t) {
  std::string text = "cell,label,x_um,y_um,z_um,volume_um3,voxels,neighbours,at_border,at_vessel\n";
  for (std::size_t k = 0; k < t.cell.size(); ++k) {
    const ImportedCell& c = t.cell[k];
    text += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{:d},{:d}\n", k, c.label,
                        c.center[0], c.center[1], c.center[2], c.volume, c.n_voxel, c.neighbours,
                        c.at_border, c.at_vessel);
  }
  return text;
}

std::string left_out_text(const ImportedTissue& t) {
  std::string text = "label,voxels,x_um,y_um,z_um,why\n";
  for (const LeftOut& l : t.left_out)
    text += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{}\n", l.label, l.n_voxel, l.center[0],
                        l.center[1], l.center[2], quoted(l.why));
  return text;
}

}  // namespace

std::vector<std::string> write_tissue(const ImportedTissue& t, const ImportOptions& o,
                                      const TissueScene& tissue, const std::string& folder) {
  namespace fs = std::filesystem;
  check(!fs::exists(folder),
        fmt::format("{}: exists already. Choose another --out, or remove it.", folder));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) io::fail_on_disk(folder, "make the folder", error.value());
  UnfinishedFolder made{folder};
  std::vector<std::string> written;
  const auto path_of = [&](const char* name) {
    return written.emplace_back((fs::path(folder) / name).string());
  };
  std::string name = fs::path(folder).lexically_normal().filename().string();
  if (name.empty()) name = fs::path(folder).lexically_normal().parent_path().filename().string();
  if (!is_name(name)) name = "tissue";
  const std::string scene = path_of(kScene);
  std::vector<geometry::Surface> surface;
  std::vector<imaging::Label> label;
  for (const ImportedCell& c : t.cell) {
    surface.push_back(c.surface);
    label.push_back(c.label);
  }
  io::write_surfaces(path_of(kCells), surface, label);
  io::write_text_file(path_of(kTable), cells_text(t));
  if (!t.vessel.empty()) {
    const std::vector<imaging::Label> number(t.vessel.size(), o.vessel_label);
    io::write_surfaces(path_of(kVessels), t.vessel, number);
  }
  if (!t.left_out.empty()) io::write_text_file(path_of(kLeftOut), left_out_text(t));
  io::write_text_file(scene, scene_text(t, o.image, tissue, name));
  read_scene(scene);  // throws where it could not be run
  made.finished = true;
  return written;
}

}  // namespace acinus::runs
