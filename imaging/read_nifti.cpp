/// Reader of NIfTI: the header by its own library, the data block by block.

#include <fmt/format.h>
#include <nifti2_io.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "imaging/image_formats.hpp"

namespace acinus::imaging {
namespace {

constexpr std::array<std::pair<int, Scalar>, 10> kNiftiTypes{{
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

/// Throws Error at data offsets that the library would convert unchecked.
void check_header(const std::string& path) {
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  int version = 0;
  const std::unique_ptr<void, Free> header(nifti_read_header(path.c_str(), &version, 0));
  check(header != nullptr, fmt::format("{}: is no NIfTI image, or damaged. Write it again.", path));
  if (version != 0 && version != 1) return;  // a whole number in NIfTI-2
  constexpr double kMost = 1e9;
  const double offset = static_cast<double>(static_cast<nifti_1_header*>(header.get())->vox_offset);
  check(offset >= 0 && offset <= kMost && offset == std::floor(offset),
        fmt::format("{}: the header says that the data begin at byte {} (vox_offset); a whole "
                    "number from 0 is needed. Write the image again.",
                    path, offset));
}

NiftiImage open_nifti(const std::string& path) {
  check(std::filesystem::is_regular_file(path),
        fmt::format("{}: no such file. Check the path.", path));
  nifti_set_debug_level(0);
  check_header(path);
  NiftiImage n(nifti_image_read(path.c_str(), 0));
  check(n != nullptr, fmt::format("{}: is no NIfTI image, or damaged. Write it again.", path));
  return n;
}

/// Bytes in a file after decompression. Throws Error where a gzip stream is damaged: only its end
/// has the checksum.
double inflated_size(const std::string& path) {
  if (nifti_is_gzfile(path.c_str()) == 0)
    return static_cast<double>(std::filesystem::file_size(path));
  struct Close {
    void operator()(gzFile_s* f) const { gzclose(f); }
  };
  const std::unique_ptr<gzFile_s, Close> file(gzopen(path.c_str(), "rb"));
  std::vector<char> buffer(1 << 20);
  double size = 0;
  int n = 0;
  while (file && (n = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0)
    size += n;
  int error = Z_OK;
  if (file) gzerror(file.get(), &error);
  check(file && n == 0 && error == Z_OK,
        fmt::format("{}: the compressed data are truncated or damaged. Write the image again.",
                    path));
  return size;
}

/// Throws Error unless the file has exactly the bytes that its header announces.
void check_length(const nifti_image& n, const std::string& data_path) {
  const double announced =
      static_cast<double>(n.iname_offset) + static_cast<double>(n.nvox) * n.nbyper;
  const double found = inflated_size(data_path);
  check(
      found == announced,
      fmt::format("{}: {:.0f} bytes where the header announces {:.0f} ({} x {} x {} voxels of {} "
                  "bytes, {} in all, from byte {}). The file is truncated or damaged, or its "
                  "sizes are wrong.",
                  data_path, found, announced, n.nx, n.ny, n.nz, n.nbyper, n.nvox, n.iname_offset));
}

/// Reads the sides of a voxel from pixdim and from the affine, which may disagree.
void take_steps(const nifti_image& n, ImageFile& file) {
  file.step = Vec3(std::abs(n.dx), std::abs(n.dy), std::abs(n.dz));
  const auto axes_of = [](const nifti_dmat44& m) {
    Eigen::Matrix3d axes;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) axes(row, column) = m.m[row][column];
    return axes;
  };
  if (n.sform_code > 0) {
    const Eigen::Matrix3d axes = axes_of(n.sto_xyz);
    const Vec3 by_affine = axes.colwise().norm();
    constexpr double kSame = 1e-3;
    if (!((by_affine - file.step).cwiseAbs().array() <= kSame * file.step.array()).all())
      file.step_fault = fmt::format(
          "pixdim says voxels of {:.6g} x {:.6g} x {:.6g}, the affine (sform) {:.6g} x {:.6g} x "
          "{:.6g}",
          file.step[0], file.step[1], file.step[2], by_affine[0], by_affine[1], by_affine[2]);
    note_axes(axes, "the affine (sform)", file);
  } else if (n.qform_code > 0) {
    note_axes(axes_of(n.qto_xyz), "the affine (qform)", file);
  }
}

Scalar type_of(const std::string& path, const nifti_image& n) {
  for (const auto& [code, type] : kNiftiTypes)
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
  const NiftiImage n = open_nifti(path);
  ImageFile file;
  file.type = type_of(path, *n);
  file.size = {n->nx, n->ny, n->nz};
  const std::size_t voxels = prepare_rows(path, file), bytes = voxels * bytes_of(file.type);
  check(n->nvox > 0 && static_cast<std::size_t>(n->nvox) % voxels == 0 &&
            n->nbyper == static_cast<int>(bytes_of(file.type)),
        fmt::format("{}: the header's sizes do not fit each other. Write the image again.", path));
  const std::int64_t n_channel = n->nvox / static_cast<std::int64_t>(voxels);
  const std::string data_path = n->iname ? n->iname : path;
  check_announced(path, static_cast<double>(bytes) * static_cast<double>(n_channel),
                  static_cast<double>(std::filesystem::file_size(data_path)),
                  nifti_is_gzfile(data_path.c_str()) != 0);
  check_length(*n, data_path);
  check_stack(path, file.size, n_channel);
  const std::int64_t chosen = channel.among(path, n_channel);
  const bool scaled =
      n->scl_slope != 0 && std::isfinite(n->scl_slope) && (n->scl_slope != 1 || n->scl_inter != 0);
  check(!scaled,
        fmt::format("{}: its numbers are to be scaled by {} and shifted by {}; labels must "
                    "be as they are. Save it as whole numbers.",
                    path, n->scl_slope, n->scl_inter));
  take_steps(*n, file);
  file.unit = Vec3::Constant(unit_of(*n));
  ImageBytes data;
  data.path = data_path;
  data.compressed = nifti_is_gzfile(data_path.c_str()) != 0;
  data.swap = n->byteorder != nifti_short_order();
  data.skip = static_cast<std::uint64_t>(n->iname_offset) + chosen * bytes;
  data.rest = (n_channel - chosen - 1) * bytes;
  take_bytes(data, file);
  return file;
}

}  // namespace acinus::imaging
