#include "core/image/read_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/image/image_formats.hpp"
#include "core/image/inflate.hpp"
#include "core/mesh/input_file.hpp"

namespace acinus::image {
namespace {

bool ends_with(std::string_view text, std::string_view end) { return text.ends_with(end); }

ImageFile read_file(const std::string& path, const ReadImage& how) {
  const std::string name = mesh::lower_case(path);
  const auto is = [&](std::initializer_list<const char*> endings) {
    return std::ranges::any_of(endings, [&](const char* e) { return ends_with(name, e); });
  };
  const ChannelChoice channel{how.channel};
  if (is({".tif", ".tiff"})) return read_tiff(path, channel);
  if (is({".nii", ".nii.gz", ".hdr"})) return read_nifti(path, channel);
  if (is({".mha", ".mhd"})) return read_metaimage(path);
  if (is({".nrrd", ".nhdr"})) return read_nrrd(path);
  if (is({".h5", ".hdf5"})) return read_hdf5(path, how.dataset);
  throw Error(
      fmt::format("{}: images are read from .tif, .nii, .nii.gz, .mha, .mhd, .nrrd, .nhdr and .h5, "
                  "not {}. Save it as one of these.",
                  path, mesh::in_quotes(mesh::extension_of(path))));
}

Vec3 voxel_of(const std::string& path, const ImageFile& file, const ReadImage& how) {
  if (how.voxel) return *how.voxel;
  const bool known = (file.step.array() > 0).all() && file.step.allFinite();
  check(known || (file.step.array() == 0).any(),
        fmt::format("{}: its voxels have the sides {}, {} and {}; all must be above 0. Give them "
                    "with --voxel \"0.5 um, 0.5 um, 1 um\" (x, y, z).",
                    path, file.step[0], file.step[1], file.step[2]));
  check(known, fmt::format("{}: the file does not say how large a voxel is{}. Give it with --voxel "
                           "\"0.5 um, 0.5 um, 1 um\" (x, y, z).",
                           path, file.step[0] > 0 ? " along z" : ""));
  const double unit = file.unit > 0 ? file.unit : how.unit;
  check(unit > 0,
        fmt::format("{}: its voxels are {} x {} x {}, without a unit. Give it with --unit "
                    "\"1 um\", or the voxel with --voxel.",
                    path, file.step[0], file.step[1], file.step[2]));
  return unit * file.step;
}

void check_voxel(const std::string& path, const Vec3& v) {
  constexpr double kLeast = 1e-3, kMost = 1e3;  // um
  check(v.minCoeff() >= kLeast && v.maxCoeff() <= kMost,
        fmt::format("{}: voxels of {:.4g} x {:.4g} x {:.4g} um; from {} to {} um is allowed. Check "
                    "the unit, or give --voxel.",
                    path, v[0], v[1], v[2], kLeast, kMost));
}

}  // namespace

std::int64_t ChannelChoice::among(const std::string& path, std::int64_t n) const {
  check(n <= 1 || channel >= 0,
        fmt::format("{}: has {} channels or times. Say which holds the labels: --channel 0 to {}.",
                    path, n, n - 1));
  check(channel < std::max<std::int64_t>(n, 1),
        fmt::format("{}: --channel {}: the image has {}, numbered from 0.", path, channel,
                    std::max<std::int64_t>(n, 1)));
  return std::max<std::int64_t>(channel, 0);
}

double unit_by_name(std::string_view name) {
  // Micro is one of two characters in UTF-8, or one byte in Latin-1 (ImageJ).
  constexpr std::array<std::pair<std::string_view, double>, 20> kNames{{
      {"um", 1},           {"\xc2\xb5m", 1},    {"\xce\xbcm", 1},    {"\xb5m", 1},
      {"\\u00b5m", 1},     {"micron", 1},       {"microns", 1},      {"micrometer", 1},
      {"micrometre", 1},   {"micrometers", 1},  {"nm", 1e-3},        {"nanometer", 1e-3},
      {"mm", 1e3},         {"millimeter", 1e3}, {"millimetre", 1e3}, {"cm", 1e4},
      {"centimeter", 1e4}, {"m", 1e6},          {"meter", 1e6},      {"inch", 25400},
  }};
  const std::string lower = mesh::lower_case(name);
  for (const auto& [text, um] : kNames)
    if (lower == text) return um;
  return 0;
}

void check_announced(const std::string& path, double announced, double stored, bool compressed) {
  constexpr double kMost = 5000;
  check(announced <= stored * (compressed ? kMost : 1),
        fmt::format("{}: {:.0f} bytes of data are announced, more than the file can hold. It is "
                    "truncated or damaged.",
                    path, announced));
}

void take_bytes(const ImageBytes& bytes, ImageFile& file) {
  const std::size_t n = count_voxels(bytes.path, file.size), size = n * bytes_of(file.type);
  std::string inflated;
  std::string_view raw = bytes.stored;
  check_announced(bytes.path, static_cast<double>(size), static_cast<double>(raw.size()),
                  true);  // without compression the sizes are compared below
  if (bytes.compressed) raw = inflated = inflate_bytes(bytes.path, bytes.stored, size);
  check(raw.size() == size,
        fmt::format("{}: {} bytes of data where {} x {} x {} voxels of {} bytes are announced. The "
                    "file is truncated, or its sizes or type are wrong.",
                    bytes.path, raw.size(), file.size[0], file.size[1], file.size[2],
                    bytes_of(file.type)));
  file.label.reserve(n);
  append_labels(bytes.path, std::as_bytes(std::span(raw.data(), raw.size())), file.type, bytes.swap,
                file.voxels(), file.label);
}

LabelImage read_image(const std::string& path, const ReadImage& how) {
  ImageFile file = read_file(path, how);
  LabelImage image;
  image.size = file.voxels();
  image.voxel = voxel_of(path, file, how);
  check_voxel(path, image.voxel);
  image.label = std::move(file.label);
  image.most_label = most_of(file.type);
  return image;
}

}  // namespace acinus::image
