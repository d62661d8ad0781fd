/// NIfTI, by its own library.

#include <fmt/format.h>
#include <nifti2_io.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/image/image_formats.hpp"

namespace acinus::image {
namespace {

constexpr std::array<std::pair<int, Scalar>, 10> kTypes{{
    {DT_UINT8, Scalar::kU8},
    {DT_INT8, Scalar::kI8},
    {DT_UINT16, Scalar::kU16},
    {DT_INT16, Scalar::kI16},
    {DT_UINT32, Scalar::kU32},
    {DT_INT32, Scalar::kI32},
    {DT_UINT64, Scalar::kU64},
    {DT_INT64, Scalar::kI64},
    {DT_FLOAT32, Scalar::kF32},
    {DT_FLOAT64, Scalar::kF64},
}};

struct FreeNifti {
  void operator()(nifti_image* n) const { nifti_image_free(n); }
};
using NiftiImage = std::unique_ptr<nifti_image, FreeNifti>;

NiftiImage open(const std::string& path) {
  check(std::filesystem::is_regular_file(path),
        fmt::format("{}: no such file. Check the path.", path));
  nifti_set_debug_level(0);
  NiftiImage n(nifti_image_read(path.c_str(), 0));
  check(n != nullptr, fmt::format("{}: is no NIfTI image, or damaged. Write it again.", path));
  return n;
}

Scalar type_of(const std::string& path, const nifti_image& n) {
  for (const auto& [code, type] : kTypes)
    if (n.datatype == code) return type;
  throw Error(fmt::format("{}: the data type {} is not read; use uint8, uint16 or uint32.", path,
                          nifti_datatype_string(n.datatype)));
}

double unit_of(const nifti_image& n) {
  if (n.xyz_units == NIFTI_UNITS_MICRON) return 1;
  if (n.xyz_units == NIFTI_UNITS_MM) return 1e3;
  return n.xyz_units == NIFTI_UNITS_METER ? 1e6 : 0;
}

}  // namespace

ImageFile read_nifti(const std::string& path, const ChannelChoice& channel) {
  const NiftiImage n = open(path);
  ImageFile file;
  file.type = type_of(path, *n);
  file.size = {n->nx, n->ny, n->nz};
  const std::size_t voxels = count_voxels(path, file.size), bytes = voxels * bytes_of(file.type);
  check(n->nvox > 0 && static_cast<std::size_t>(n->nvox) % voxels == 0,
        fmt::format("{}: the header's sizes do not fit each other. Write the image again.", path));
  const std::int64_t n_channel = n->nvox / static_cast<std::int64_t>(voxels);
  const std::int64_t chosen = channel.among(path, n_channel);
  const std::string data_path = n->iname ? n->iname : path;
  check_announced(path, static_cast<double>(bytes) * static_cast<double>(n_channel),
                  static_cast<double>(std::filesystem::file_size(data_path)),
                  nifti_is_gzfile(data_path.c_str()) != 0);
  const bool scaled =
      n->scl_slope != 0 && std::isfinite(n->scl_slope) && (n->scl_slope != 1 || n->scl_inter != 0);
  check(!scaled,
        fmt::format("{}: its numbers are to be scaled by {} and shifted by {}; labels must "
                    "be as they are. Save it as whole numbers.",
                    path, n->scl_slope, n->scl_inter));
  file.step = Vec3(std::abs(n->dx), std::abs(n->dy), std::abs(n->dz));
  file.unit = unit_of(*n);
  check(nifti_image_load(n.get()) == 0 && n->data != nullptr,
        fmt::format("{}: the data cannot be read: the file is truncated or damaged.", path));
  const auto* data = static_cast<const std::byte*>(n->data);  // in this machine's byte order
  file.label.reserve(voxels);
  append_labels(path, std::span(data + static_cast<std::size_t>(chosen) * bytes, bytes), file.type,
                false, file.voxels(), file.label);
  return file;
}

}  // namespace acinus::image
