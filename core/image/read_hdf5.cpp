/// HDF5, as ilastik, Fiji's plugin and others write it: a dataset with the axes z, y, x.

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/error.hpp"
#include "core/image/image_formats.hpp"
#include "core/io/volume_file.hpp"

namespace acinus::image {
namespace {

std::string list_of(const std::vector<io::VolumeInfo>& volumes) {
  std::string text;
  for (const io::VolumeInfo& v : volumes) text += (text.empty() ? "" : ", ") + v.name;
  return text;
}

io::VolumeInfo choose(const std::string& path, const std::string& dataset) {
  const std::vector<io::VolumeInfo> volumes = io::list_volumes(path);
  check(!volumes.empty(),
        fmt::format("{}: no dataset of numbers with three axes (z, y, x).", path));
  if (dataset.empty()) {
    check(volumes.size() == 1, fmt::format("{}: has {} images. Say which: --dataset one of {}.",
                                           path, volumes.size(), list_of(volumes)));
    return volumes.front();
  }
  const std::string name = dataset.starts_with("/") ? dataset : "/" + dataset;
  const auto found = std::ranges::find(volumes, name, &io::VolumeInfo::name);
  check(found != volumes.end(), fmt::format("{}: --dataset {}: there is none; there are {}.", path,
                                            dataset, list_of(volumes)));
  return *found;
}

Scalar type_of(const std::string& path, const io::VolumeInfo& v) {
  switch (v.bytes) {
    case 1:
      return v.has_sign ? Scalar::kI8 : Scalar::kU8;
    case 2:
      if (!v.is_real) return v.has_sign ? Scalar::kI16 : Scalar::kU16;
      break;
    case 4:
      return v.is_real ? Scalar::kF32 : v.has_sign ? Scalar::kI32 : Scalar::kU32;
    case 8:
      return v.is_real ? Scalar::kF64 : v.has_sign ? Scalar::kI64 : Scalar::kU64;
    default:
      break;
  }
  throw Error(
      fmt::format("{}: {} has numbers of {} bytes, which are not read.", path, v.name, v.bytes));
}

}  // namespace

ImageFile read_hdf5(const std::string& path, const std::string& dataset) {
  constexpr std::size_t kAxes = 3;
  const io::VolumeInfo v = choose(path, dataset);
  // Axes of length 1 (a channel, a time) may stand anywhere among the three.
  std::vector<std::size_t> axis;
  for (std::size_t k = 0; k < v.shape.size(); ++k)
    if (v.shape[k] != 1 || v.shape.size() - k <= kAxes - axis.size()) axis.push_back(k);
  check(
      axis.size() == kAxes,
      fmt::format("{}: {} has {} axes longer than 1; three are read (z, y, x). Save one channel of "
                  "one time.",
                  path, v.name, axis.size()));
  ImageFile file;
  file.type = type_of(path, v);
  file.unit = 1;
  for (std::size_t k = 0; k < kAxes; ++k) {
    const std::size_t from = axis[kAxes - 1 - k];
    file.size[k] = v.shape[from];
    if (v.element_size.size() == v.shape.size())
      file.step[static_cast<int>(k)] = v.element_size[from];
    else if (v.element_size.size() == kAxes)
      file.step[static_cast<int>(k)] = v.element_size[kAxes - 1 - k];
  }
  file.label.reserve(count_voxels(path, file.size));
  const std::vector<std::byte> bytes = io::read_volume(path, v);
  append_labels(path, bytes, file.type, false, file.voxels(), file.label);
  return file;
}

}  // namespace acinus::image
