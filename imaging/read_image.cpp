#include "imaging/read_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/image_formats.hpp"
#include "imaging/inflate.hpp"

namespace acinus::imaging {
namespace {

bool ends_with(std::string_view text, std::string_view end) { return text.ends_with(end); }

ImageFile read_file(const std::string& path, const ReadImage& how) {
  const ChannelChoice channel{how.channel, how.second};
  if (std::filesystem::is_directory(path))
    return read_zarr(path, {how.dataset, how.level}, channel);
  check(
      how.level < 0 || how.second,
      fmt::format("{}: --level chooses a resolution of OME-Zarr, which this is not. Leave it out.",
                  path));
  const std::string name = geometry::lower_case(path);
  const auto is = [&](std::initializer_list<const char*> endings) {
    return std::ranges::any_of(endings, [&](const char* e) { return ends_with(name, e); });
  };
  if (is({".h5", ".hdf5"})) return read_hdf5(path, how.dataset, channel);
  check(
      how.dataset.empty() || how.second,
      fmt::format("{}: --dataset names one of several images in an HDF5 file (.h5) or a folder of "
                  "OME-Zarr, which this is not. Leave it out.",
                  path));
  if (is({".tif", ".tiff"})) return read_tiff(path, channel);
  if (is({".nii", ".nii.gz", ".hdr"})) return read_nifti(path, channel);
  const bool meta = is({".mha", ".mhd"});
  if (meta || is({".nrrd", ".nhdr"})) {
    channel.among(path, 1);  // neither has channels here
    return meta ? read_metaimage(path) : read_nrrd(path);
  }
  throw Error(
      fmt::format("{}: images are read from .tif, .nii, .nii.gz, .mha, .mhd, .nrrd, .nhdr, .h5 and "
                  "folders of OME-Zarr, not {}. {}",
                  path, geometry::in_quotes(geometry::extension_of(path)),
                  is({".zip", ".ozx"}) ? "Unpack it: a folder of OME-Zarr is read."
                  : is({".zarr"})      ? "There is no such folder."
                                       : "Save it as one of these."));
}

constexpr const char* kGiveVoxel = "--voxel \"0.5 um, 0.5 um, 1 um\" (x, y, z)";

bool all_known(const Vec3& v) { return (v.array() > 0).all() && v.allFinite(); }

std::string text_of(const Vec3& v) {
  return fmt::format("{:.6g} x {:.6g} x {:.6g}", v[0], v[1], v[2]);
}

bool alike(const Vec3& a, const Vec3& b) {
  constexpr double kSame = 1e-3;  // sizes are written with three digits or more
  return ((a - b).cwiseAbs().array() <= kSame * b.cwiseAbs().array()).all();
}

/// Voxel size that the user gives; adds a note where the file states another.
Vec3 given_voxel(ImageFile& file, const Vec3& voxel) {
  const Vec3 said = file.step.cwiseProduct(file.unit);
  if (all_known(said) && !alike(said, voxel))
    file.note.push_back(fmt::format("the file says voxels of {} um; {} um are taken, as given",
                                    text_of(said), text_of(voxel)));
  return voxel;
}

Vec3 voxel_of(const std::string& path, ImageFile& file, const ReadImage& how) {
  if (how.voxel) return given_voxel(file, *how.voxel);
  check(file.step_fault.empty(),
        fmt::format("{}: {}. Give {}.", path, file.step_fault, kGiveVoxel));
  const bool known = all_known(file.step);
  check(known || (file.step.array() == 0).any(),
        fmt::format("{}: its voxels have the sides {}, {} and {}; all must be above 0. Give them "
                    "with {}.",
                    path, file.step[0], file.step[1], file.step[2], kGiveVoxel));
  check(known, fmt::format("{}: the file does not say how large a voxel is{}. Give it with {}.",
                           path, file.step[0] > 0 ? " along z" : "", kGiveVoxel));
  if (how.unit > 0) {
    const Vec3 given = Vec3::Constant(how.unit);
    if (all_known(file.unit) && !alike(file.unit, given))
      file.note.push_back(
          file.unit.minCoeff() == file.unit.maxCoeff()
              ? fmt::format("the file says units of {:.6g} um; {:.6g} um is taken, as --unit says",
                            file.unit[0], how.unit)
              : fmt::format("the file says units of {} um by axis; {:.6g} um is taken for all, as "
                            "--unit says",
                            text_of(file.unit), how.unit));
    return how.unit * file.step;
  }
  check(all_known(file.unit),
        fmt::format("{}: its voxels are {} x {} x {}, without a unit{}. Give it with --unit "
                    "\"1 um\", or the voxel with --voxel.",
                    path, file.step[0], file.step[1], file.step[2],
                    (file.unit.array() > 0).any() ? " along every axis" : ""));
  return file.unit.cwiseProduct(file.step);
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
  if (n <= 1 && only_if_needed) return 0;
  check(channel < std::max<std::int64_t>(n, 1),
        fmt::format("{}: --channel {}: the image has {}, numbered from 0.", path, channel,
                    std::max<std::int64_t>(n, 1)));
  return std::max<std::int64_t>(channel, 0);
}

double unit_by_name(std::string_view name) {
  // Micro is one of two characters in UTF-8, or one byte in Latin-1 (ImageJ).
  constexpr std::array<std::pair<std::string_view, double>, 27> kNames{{
      {"um", 1},           {"\xc2\xb5m", 1},    {"\xce\xbcm", 1},     {"\xb5m", 1},
      {"\\u00b5m", 1},     {"micron", 1},       {"microns", 1},       {"micrometer", 1},
      {"micrometre", 1},   {"micrometers", 1},  {"nm", 1e-3},         {"nanometer", 1e-3},
      {"mm", 1e3},         {"millimeter", 1e3}, {"millimetre", 1e3},  {"cm", 1e4},
      {"centimeter", 1e4}, {"m", 1e6},          {"meter", 1e6},       {"inch", 25400},
      {"metre", 1e6},      {"nanometre", 1e-3}, {"nanometers", 1e-3}, {"millimeters", 1e3},
      {"micrometres", 1},  {"in", 25400},       {"pm", 1e-6},
  }};
  const std::string lower = geometry::lower_case(name);
  for (const auto& [text, um] : kNames)
    if (lower == text) return um;
  return 0;
}

void check_stack(const std::string& path, const std::array<std::int64_t, 3>& size,
                 std::int64_t others) {
  check(
      *std::ranges::min_element(size) != 1,
      fmt::format("{}: the image is flat, {} x {} x {} voxels: one slice{}. Cells are made from a "
                  "stack of slices; give the whole stack in one file.",
                  path, size[0], size[1], size[2],
                  others > 1 ? fmt::format(", with {} channels or times", others) : ""));
}

void check_announced(const std::string& path, double announced, double stored, bool compressed) {
  constexpr double kMost = 5000;
  check(announced <= stored * (compressed ? kMost : 1),
        fmt::format("{}: {:.0f} bytes of data are announced, more than the file can hold. It is "
                    "truncated or damaged.",
                    path, announced));
}

std::size_t prepare_rows(const std::string& path, ImageFile& file) {
  const std::size_t n = count_voxels(path, file.size);
  file.rows.size = file.voxels();
  file.rows.line.resize(n / file.rows.size[0]);
  return n;
}

void append_lines(const std::string& path, std::span<const std::byte> bytes, bool swap,
                  std::size_t first, ImageFile& file) {
  const Voxel& size = file.rows.size;
  const std::size_t row = size[0] * bytes_of(file.type), n_y = size[1], n = bytes.size() / row;
  LabelBlock block;
  block.stride = {bytes_of(file.type), row, row * n_y};
  for (std::size_t k = 0; k < n;) {  // whole slices at once, and the parts of slices beside them
    const std::size_t y = (first + k) % n_y, z = (first + k) / n_y;
    const std::size_t slices = y == 0 ? (n - k) / n_y : 0;
    const std::size_t lines = slices > 0 ? n_y : std::min(n_y - y, n - k);
    block.bytes = bytes.subspan(k * row);
    block.first = {0, static_cast<int>(y), static_cast<int>(z)};
    block.size = {size[0], static_cast<int>(lines), std::max(1, static_cast<int>(slices))};
    append_labels(path, block, file.type, swap, file.fill, file.rows);
    k += lines * static_cast<std::size_t>(block.size[2]);
  }
}

void take_bytes(const ImageBytes& bytes, ImageFile& file) {
  const std::uint64_t line = file.rows.size[0] * bytes_of(file.type);
  const std::uint64_t voxels = line * file.rows.line.size();
  const std::uint64_t all = bytes.skip + voxels + bytes.rest;
  const std::uint64_t stored = std::filesystem::file_size(bytes.path) - bytes.from;
  check_announced(bytes.path, static_cast<double>(voxels), static_cast<double>(stored),
                  true);  // without compression the sizes are compared below
  check(bytes.compressed || stored == all,
        fmt::format("{}: {} bytes of data where {} x {} x {} voxels of {} bytes are announced. The "
                    "file is truncated, or its sizes or type are wrong.",
                    bytes.path, stored, file.size[0], file.size[1], file.size[2],
                    bytes_of(file.type)));
  std::ifstream in(bytes.path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(bytes.from));
  const auto read_file = [&](std::span<char> out) {
    in.read(out.data(), static_cast<std::streamsize>(out.size()));
    check(!in.bad(), fmt::format("{}: cannot be read. Check the disk.", bytes.path),
          Exit::kFileError);
    return static_cast<std::size_t>(in.gcount());
  };
  std::optional<Inflater> inflater;
  if (bytes.compressed) inflater.emplace(bytes.path, all, read_file);
  const auto read = [&](std::span<char> out) {
    if (inflater)
      inflater->read(out);
    else
      check(read_file(out) == out.size(),
            fmt::format("{}: became shorter while it was read.", bytes.path), Exit::kFileError);
  };
  constexpr std::uint64_t kBlock = 1 << 24;  // bytes
  std::vector<char> buffer;
  const auto skip = [&](std::uint64_t n) {
    for (; n > 0; n -= buffer.size()) {
      buffer.resize(std::min(n, kBlock));
      read(buffer);
    }
  };
  skip(bytes.skip);
  const std::size_t most = std::max<std::uint64_t>(1, kBlock / line);
  for (std::size_t first = 0; first < file.rows.line.size(); first += most) {
    buffer.resize(line * std::min(most, file.rows.line.size() - first));
    read(buffer);
    append_lines(bytes.path, std::as_bytes(std::span(buffer)), bytes.swap, first, file);
  }
  skip(bytes.rest);
  if (inflater) inflater->finish();
}

void note_axes(const Eigen::Matrix3d& axes, const std::string& named, ImageFile& file) {
  constexpr double kRight = 1e-3;  // of 1: written with three digits or more
  const Eigen::Matrix3d unit = axes.colwise().normalized();
  if (!unit.allFinite()) return;
  const Eigen::Matrix3d off = unit.transpose() * unit - Eigen::Matrix3d::Identity();
  if (off.cwiseAbs().maxCoeff() > kRight)
    file.note.push_back(named +
                        " has axes that are not at right angles; voxels are taken as boxes");
  else if (unit.determinant() < 0)
    file.note.push_back(named +
                        " mirrors the image; it is taken as stored, so left and right are "
                        "exchanged");
}

LabelRows read_image(const std::string& path, const ReadImage& how,
                     std::vector<std::string>* notes) {
  check(
      !how.voxel || how.unit == 0 || how.second,
      fmt::format("{}: --unit has no effect beside --voxel, which says all. Leave one out.", path));
  ImageFile file = read_file(path, how);
  check_stack(path, file.size);
  LabelRows image = std::move(file.rows);
  complete_lines(file.fill, image);
  image.voxel = voxel_of(path, file, how);
  check_voxel(path, image.voxel);
  image.most_label = most_of(file.type);
  if (notes != nullptr)
    for (const std::string& n : file.note) notes->push_back(fmt::format("{}: {}", path, n));
  return image;
}

}  // namespace acinus::imaging
