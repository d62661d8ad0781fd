#include "imaging/write_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/inflate.hpp"
#include "imaging/tiff_handle.hpp"
#include "io/disk.hpp"

namespace acinus::imaging {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the headers below say

/// Bytes per label that hold all labels of an image.
std::size_t bytes_needed(const LabelImage& image) {
  Label most = 0;
  for (const Label l : image.label) most = std::max(most, l);
  if (most <= std::numeric_limits<std::uint8_t>::max()) return 1;
  return most <= std::numeric_limits<std::uint16_t>::max() ? 2 : 4;
}

/// Labels of a run of voxels, in `bytes` bytes each.
std::string narrow(const Label* label, std::size_t n, std::size_t bytes) {
  std::string out(n * bytes, '\0');
  for (std::size_t k = 0; k < n; ++k) std::memcpy(out.data() + k * bytes, label + k, bytes);
  return out;
}

std::string all_bytes(const LabelImage& image, std::size_t bytes) {
  return narrow(image.label.data(), image.label.size(), bytes);
}

std::string metaimage_text(const LabelImage& i) {
  const std::size_t bytes = bytes_needed(i);
  const std::string data = deflate_bytes(all_bytes(i, bytes), false);
  return fmt::format(
             "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
             "CompressedData = True\nCompressedDataSize = {}\nDimSize = {} {} {}\n"
             "ElementSpacing = {} {} {}\nDistanceUnits = um\nElementType = {}\n"
             "ElementDataFile = LOCAL\n",
             data.size(), i.size[0], i.size[1], i.size[2], i.voxel[0], i.voxel[1], i.voxel[2],
             bytes == 1   ? "MET_UCHAR"
             : bytes == 2 ? "MET_USHORT"
                          : "MET_UINT") +
         data;
}

std::string nrrd_text(const LabelImage& i) {
  const std::size_t bytes = bytes_needed(i);
  return fmt::format(
             "NRRD0004\ntype: uint{}\ndimension: 3\nsizes: {} {} {}\nspacings: {} {} {}\n"
             "units: \"um\" \"um\" \"um\"\nendian: little\nencoding: gzip\n\n",
             8 * bytes, i.size[0], i.size[1], i.size[2], i.voxel[0], i.voxel[1], i.voxel[2]) +
         deflate_bytes(all_bytes(i, bytes), true);
}

/// Largest classic TIFF, bytes; beyond it addresses need 64 bits.
constexpr double kMostClassic = 3.9e9;

void write_tiff(const std::string& path, const LabelImage& i) {
  io::RemoveUnlessMoved part{path + ".part"};
  const std::size_t bytes = bytes_needed(i), row = i.size[0];
  const bool big = static_cast<double>(bytes * i.label.size()) > kMostClassic;
  const auto failed = [&] { io::fail_on_disk(path, "write the image", errno); };
  TIFFSetErrorHandler(nullptr);
  TiffFile file(TIFFOpen(part.path.c_str(), big ? "w8" : "w"));
  if (!file) failed();
  TIFF* t = file.get();
  const std::string description =
      fmt::format("ImageJ=1.53t\nimages={}\nslices={}\nunit=micron\nspacing={}\nloop=false\n",
                  i.size[2], i.size[2], i.voxel[2]);
  for (int z = 0; z < i.size[2]; ++z) {
    TIFFSetField(t, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(i.size[0]));
    TIFFSetField(t, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(i.size[1]));
    TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, static_cast<std::uint16_t>(8 * bytes));
    TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, std::uint16_t{1});
    TIFFSetField(t, TIFFTAG_SAMPLEFORMAT, std::uint16_t{SAMPLEFORMAT_UINT});
    TIFFSetField(t, TIFFTAG_PHOTOMETRIC, std::uint16_t{PHOTOMETRIC_MINISBLACK});
    TIFFSetField(t, TIFFTAG_COMPRESSION, std::uint16_t{COMPRESSION_ADOBE_DEFLATE});
    TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(i.size[1]));
    TIFFSetField(t, TIFFTAG_RESOLUTIONUNIT, std::uint16_t{RESUNIT_NONE});
    TIFFSetField(t, TIFFTAG_XRESOLUTION, 1 / i.voxel[0]);
    TIFFSetField(t, TIFFTAG_YRESOLUTION, 1 / i.voxel[1]);
    if (z == 0) TIFFSetField(t, TIFFTAG_IMAGEDESCRIPTION, description.c_str());
    for (int y = 0; y < i.size[1]; ++y) {
      std::string line = narrow(&i.label[i.index({0, y, z})], row, bytes);
      if (TIFFWriteScanline(t, line.data(), static_cast<std::uint32_t>(y), 0) < 0) failed();
    }
    if (TIFFWriteDirectory(t) == 0) failed();
  }
  file.reset();
  io::sync_file(part.path);
  io::replace_file(part.path, path);
}

}  // namespace

void check_image_file(const std::string& path) {
  const std::string ending = geometry::extension_of(path);
  check(ending == ".tif" || ending == ".tiff" || ending == ".mha" || ending == ".nrrd",
        fmt::format("{}: images are written as .tif, .mha or .nrrd, not {}. Choose one of these "
                    "endings.",
                    path, geometry::in_quotes(ending)));
}

void write_image(const std::string& path, const LabelImage& image) {
  check_image_file(path);
  const std::string ending = geometry::extension_of(path);
  if (ending == ".mha")
    io::write_text_file(path, metaimage_text(image));
  else if (ending == ".nrrd")
    io::write_text_file(path, nrrd_text(image));
  else
    write_tiff(path, image);
}

}  // namespace acinus::imaging
