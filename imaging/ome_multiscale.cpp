#include "imaging/ome_multiscale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "imaging/zarr_json.hpp"

namespace acinus::imaging {
namespace {

namespace fs = std::filesystem;

/// Metadata of a group; nothing where the folder is none.
std::optional<JsonFile> read_group(const std::string& folder) {
  for (const char* name : {"/zarr.json", "/.zattrs"})
    if (fs::is_regular_file(folder + name)) return JsonFile::read(folder + name);
  return std::nullopt;
}

/// Part of the metadata of a group that OME defines: .zattrs of 0.4, attributes/ome of 0.5.
/// @pre group
std::optional<JsonPart> ome_part(const JsonFile& group) {
  JsonPart part = group.root();
  if (!group.path.ends_with("zarr.json")) return part;
  for (const char* name : {"attributes", "ome"}) {
    if (!part.has(name)) return std::nullopt;
    part = part.at(name);
  }
  return part;
}

bool has_part(const std::string& folder, const char* name) {
  const std::optional<JsonFile> group = read_group(folder);
  const std::optional<JsonPart> ome = group ? ome_part(*group) : std::nullopt;
  return ome && ome->has(name);
}

/// Folders directly in one that are images, by name.
std::vector<std::string> images_in(const std::string& folder) {
  std::vector<std::string> all;
  std::error_code none;
  for (const fs::directory_entry& e : fs::directory_iterator(folder, none))
    if (e.is_directory() && has_part(e.path().string(), "multiscales"))
      all.push_back(e.path().filename().string());
  std::ranges::sort(all);
  return all;
}

/// Names of the label images in a folder "labels": those that it lists, or those that are there.
std::vector<std::string> labels_in(const std::string& folder) {
  const std::optional<JsonFile> group = read_group(folder);
  const std::optional<JsonPart> ome = group ? ome_part(*group) : std::nullopt;
  if (!ome || !ome->has("labels")) return images_in(folder);
  std::vector<std::string> all;
  for (const JsonPart& name : ome->at("labels").items()) all.push_back(name.text());
  return all;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& n : names) text += (text.empty() ? "" : ", ") + n;
  return text;
}

[[noreturn]] void fail_without_image(const std::string& folder) {
  const bool array = fs::exists(folder + "/.zarray") ||
                     (fs::exists(folder + "/zarr.json") &&
                      JsonFile::read(folder + "/zarr.json").root().has("shape"));
  if (array)
    throw Error(
        fmt::format("{}: is one array of zarr. Give the folder of the image around it, "
                    "which has its axes and sizes, and the level with --level.",
                    folder));
  const std::vector<std::string> images = images_in(folder);
  throw Error(
      images.empty()
          ? fmt::format("{}: holds no image of OME-Zarr: no \"multiscales\" in zarr.json or "
                        ".zattrs, and no labels. A folder of OME-Zarr 0.4 or 0.5 is needed.",
                        folder)
          : fmt::format("{}: holds several images: {}. Give the folder of one of them.", folder,
                        list_of(images)));
}

/// Numbers of a transformation of a type; empty where the list has none.
std::vector<double> transformation(const JsonPart& list, const std::string& type,
                                   std::size_t axes) {
  std::vector<double> found;
  for (const JsonPart& t : list.items()) {
    const JsonPart name = t.at("type");
    if (name.text() != "scale" && name.text() != "translation" && name.text() != "identity")
      name.fail("scale and translation are read. Write the image again");
    if (name.text() != type) continue;
    if (!found.empty()) name.fail(fmt::format("a second {}; one is allowed", type));
    if (!t.has(type)) t.fail(fmt::format("\"{}\" with a number an axis is needed", type));
    found = t.at(type).numbers();
    if (found.size() != axes)
      t.at(type).fail(fmt::format("{} numbers are needed, one an axis", axes));
    for (const double v : found)
      if (!std::isfinite(v) || (type == "scale" && v <= 0))
        t.at(type).fail(type == "scale" ? "numbers above 0 are needed"
                                        : "finite numbers are needed");
  }
  return found;
}

void take_level(const JsonPart& image, const JsonPart& dataset, OmeMultiscale& m) {
  const std::size_t n = m.axis.size();
  const char* const kName = "coordinateTransformations";
  OmeLevel level;
  level.path = dataset.at("path").text();
  level.translation.assign(n, 0);
  if (dataset.has(kName)) {
    level.scale = transformation(dataset.at(kName), "scale", n);
    const std::vector<double> moved = transformation(dataset.at(kName), "translation", n);
    if (!moved.empty()) level.translation = moved;
  }
  if (level.scale.empty())
    level.fault = fmt::format("level {} (\"{}\") has no scale among its coordinateTransformations",
                              m.level.size(), level.path);
  if (image.has(kName)) {
    const std::vector<double> scale = transformation(image.at(kName), "scale", n),
                              moved = transformation(image.at(kName), "translation", n);
    for (std::size_t k = 0; k < n; ++k) {
      if (!scale.empty() && !level.scale.empty()) level.scale[k] *= scale[k];
      if (!scale.empty()) level.translation[k] *= scale[k];
      if (!moved.empty()) level.translation[k] += moved[k];
    }
  }
  m.level.push_back(level);
}

OmeAxis axis_of(const JsonPart& p) {
  OmeAxis a;
  if (!p.is_object())
    p.fail(
        "an axis of OME-Zarr 0.4 is an object with name, type and unit. "
        "Convert the image to 0.4 or 0.5");
  a.name = p.at("name").text();
  if (p.has("type") && !p.at("type").is_null()) a.type = p.at("type").text();
  if (p.has("unit") && !p.at("unit").is_null()) a.unit = p.at("unit").text();
  return a;
}

void check_version(const JsonPart& image, const JsonPart& ome) {
  const JsonPart& holder = image.has("version") ? image : ome;
  if (!holder.has("version")) return;
  const JsonPart v = holder.at("version");
  if (v.text() != "0.4" && v.text() != "0.5" && !v.text().starts_with("0.5."))
    v.fail("versions 0.4 and 0.5 of OME-Zarr are read. Convert the image to one of them");
}

}  // namespace

std::string choose_ome_image(const std::string& folder, const std::string& said, bool lenient) {
  const std::string labels = fs::is_directory(folder + "/labels") ? folder + "/labels" : folder;
  const bool is_list = labels != folder || has_part(folder, "labels");
  const std::vector<std::string> names = is_list ? labels_in(labels) : std::vector<std::string>{};
  if (said.empty() || (lenient && names.size() < 2)) {
    if (names.size() == 1) return labels + "/" + names[0];
    check(names.empty(), fmt::format("{}: has {} label images. Say which: --dataset one of {}.",
                                     folder, names.size(), list_of(names)));
    if (!has_part(folder, "multiscales")) fail_without_image(folder);
    return folder;
  }
  for (const std::string& at : {labels + "/" + said, folder + "/" + said})
    if (fs::is_directory(at)) return at;
  throw Error(fmt::format("{}: --dataset {}: there is no such folder; {}.", folder, said,
                          names.empty() ? "it has no labels. Leave --dataset out"
                                        : "its labels are " + list_of(names)));
}

OmeMultiscale read_multiscale(const std::string& folder) {
  const std::optional<JsonFile> group = read_group(folder);
  const std::optional<JsonPart> ome = group ? ome_part(*group) : std::nullopt;
  if (!ome || !ome->has("multiscales")) fail_without_image(folder);
  const std::vector<JsonPart> images = ome->at("multiscales").items();
  if (images.size() != 1) ome->at("multiscales").fail("one image is read. Write a folder an image");
  const JsonPart& image = images.front();
  check_version(image, *ome);
  OmeMultiscale m;
  m.file = group->path;
  m.is_label = ome->has("image-label");
  check(image.has("axes"),
        fmt::format("{}: the image names no axes, as before version 0.4 of OME-Zarr. Convert it to "
                    "0.4 or 0.5.",
                    group->path));
  for (const JsonPart& a : image.at("axes").items()) m.axis.push_back(axis_of(a));
  for (const JsonPart& d : image.at("datasets").items()) take_level(image, d, m);
  if (m.level.empty()) image.at("datasets").fail("at least one level is needed");
  return m;
}

}  // namespace acinus::imaging
