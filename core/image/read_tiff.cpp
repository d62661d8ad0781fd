/// TIFF stacks, by libtiff: a page a slice.

#include <fmt/format.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/image/image_formats.hpp"
#include "core/image/tiff_handle.hpp"
#include "core/image/tiff_text.hpp"

namespace acinus::image {
namespace {

std::string& last_words() {
  thread_local std::string words;
  return words;
}

/// libtiff tells errors to a function of the process.
void keep_words(const char* module, const char* format, va_list values) {
  std::array<char, 400> text{};
  std::vsnprintf(text.data(), text.size(), format, values);
  last_words() = fmt::format("{}{}{}", module ? module : "", module ? ": " : "", text.data());
}

TiffFile open(const std::string& path) {
  check(std::filesystem::is_regular_file(path),
        fmt::format("{}: no such file. Check the path.", path));
  TIFFSetWarningHandler(nullptr);
  TIFFSetErrorHandler(keep_words);
  last_words().clear();
  TiffFile tiff(TIFFOpen(path.c_str(), "r"));
  check(tiff != nullptr, fmt::format("{}: cannot be read as TIFF: {}", path, last_words()));
  return tiff;
}

struct TiffPage {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT;
  bool operator==(const TiffPage&) const = default;
};

TiffPage page_of(TIFF* t) {
  TiffPage p;
  TIFFGetField(t, TIFFTAG_IMAGEWIDTH, &p.width);
  TIFFGetField(t, TIFFTAG_IMAGELENGTH, &p.height);
  TIFFGetFieldDefaulted(t, TIFFTAG_BITSPERSAMPLE, &p.bits);
  TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLESPERPIXEL, &p.samples);
  TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLEFORMAT, &p.format);
  return p;
}

Scalar type_of(const std::string& path, const TiffPage& p) {
  check(p.samples == 1,
        fmt::format("{}: {} numbers a pixel: a colour picture. Save the labels themselves, one "
                    "number a pixel.",
                    path, p.samples));
  const bool real = p.format == SAMPLEFORMAT_IEEEFP, with_sign = p.format == SAMPLEFORMAT_INT;
  switch (p.bits) {
    case 8:
      if (!real) return with_sign ? Scalar::kI8 : Scalar::kU8;
      break;
    case 16:
      if (!real) return with_sign ? Scalar::kI16 : Scalar::kU16;
      break;
    case 32:
      return real ? Scalar::kF32 : with_sign ? Scalar::kI32 : Scalar::kU32;
    case 64:
      return real ? Scalar::kF64 : with_sign ? Scalar::kI64 : Scalar::kU64;
    default:
      break;
  }
  throw Error(fmt::format("{}: {} bits a pixel are not read; use 8, 16 or 32.", path, p.bits));
}

/// The rows of a page, from its strips or tiles.
void read_page(const std::string& path, TIFF* t, const TiffPage& page, std::int64_t number,
               std::vector<std::byte>& rows) {
  const std::size_t bytes = page.bits / 8u, row = page.width * bytes;
  const auto damaged = [&] {
    return Error(fmt::format("{}: page {} cannot be read: {}. The file is truncated or damaged.",
                             path, number, last_words()));
  };
  if (TIFFIsTiled(t) == 0) {
    if (static_cast<std::size_t>(TIFFScanlineSize64(t)) != row) throw damaged();
    for (std::uint32_t y = 0; y < page.height; ++y)
      if (TIFFReadScanline(t, rows.data() + y * row, y, 0) < 0) throw damaged();
    return;
  }
  std::uint32_t wide = 0, high = 0;
  TIFFGetField(t, TIFFTAG_TILEWIDTH, &wide);
  TIFFGetField(t, TIFFTAG_TILELENGTH, &high);
  constexpr std::uint32_t kMostTile = 1 << 14;
  if (wide == 0 || high == 0 || wide > kMostTile || high > kMostTile) throw damaged();
  std::vector<std::byte> tile(static_cast<std::size_t>(TIFFTileSize64(t)));
  if (tile.size() < wide * high * bytes) throw damaged();
  for (std::uint32_t y = 0; y < page.height; y += high)
    for (std::uint32_t x = 0; x < page.width; x += wide) {
      if (TIFFReadTile(t, tile.data(), x, y, 0, 0) < 0) throw damaged();
      const std::uint32_t columns = std::min(wide, page.width - x);
      for (std::uint32_t r = 0; r < std::min(high, page.height - y); ++r)
        std::copy_n(tile.data() + r * wide * bytes, columns * bytes,
                    rows.data() + (y + r) * row + x * bytes);
    }
}

/// um of a pixel along an axis, from its resolution in ImageJ's unit.
double pixel_size(TIFF* t, std::uint32_t tag, double unit) {
  float per_unit = 0;
  return TIFFGetField(t, tag, &per_unit) == 1 && per_unit > 0 ? unit / static_cast<double>(per_unit)
                                                              : 0;
}

TiffText describe(const std::string& path, TIFF* t) {
  const char* description = nullptr;
  const bool has = TIFFGetField(t, TIFFTAG_IMAGEDESCRIPTION, &description) == 1 && description;
  TiffText text = read_tiff_text(path, has ? description : "");
  if (text.pixel_unit > 0) {
    text.step[0] = pixel_size(t, TIFFTAG_XRESOLUTION, text.pixel_unit);
    text.step[1] = pixel_size(t, TIFFTAG_YRESOLUTION, text.pixel_unit);
  }
  const std::int64_t pages = TIFFNumberOfDirectories(t);
  check(text.images <= pages || pages > 1,
        fmt::format("{}: ImageJ wrote {} slices behind a single page, as it does beyond 4 GB. Save "
                    "it as OME-TIFF.",
                    path, text.images));
  if (text.slices == 0) text.slices = pages / (text.channels * text.times);
  check(text.slices * text.channels * text.times == pages,
        fmt::format("{}: {} pages, but its description speaks of {} slices, {} channels and {} "
                    "times. Parts may be in other files: write one file.",
                    path, pages, text.slices, text.channels, text.times));
  return text;
}

}  // namespace

ImageFile read_tiff(const std::string& path, const ChannelChoice& channel) {
  const TiffFile tiff = open(path);
  const TiffText text = describe(path, tiff.get());
  const std::int64_t chosen = channel.among(path, text.channels * text.times);
  const TiffPage first = page_of(tiff.get());
  ImageFile file;
  file.type = type_of(path, first);
  file.size = {first.width, first.height, text.slices};
  file.step = text.step;
  file.unit = 1;
  const std::size_t voxels = count_voxels(path, file.size);
  check_announced(path, static_cast<double>(voxels * bytes_of(file.type)),
                  static_cast<double>(std::filesystem::file_size(path)), true);
  file.label.reserve(voxels);
  std::vector<std::byte> rows(static_cast<std::size_t>(first.width) * first.height *
                              bytes_of(file.type));
  for (std::int64_t slice = 0; slice < text.slices; ++slice) {
    const std::int64_t number = text.page(slice, chosen);
    check(TIFFSetDirectory(tiff.get(), static_cast<tdir_t>(number)) == 1,
          fmt::format("{}: page {} is missing or damaged: {}", path, number, last_words()));
    const TiffPage page = page_of(tiff.get());
    check(
        page == first,
        fmt::format("{}: page {} has {} x {} pixels of {} bits, the first {} x {} of {}. All must "
                    "be alike: export the stack without thumbnails or pyramids.",
                    path, number, page.width, page.height, page.bits, first.width, first.height,
                    first.bits));
    read_page(path, tiff.get(), page, number, rows);
    append_labels(path, rows, file.type, false, file.voxels(), file.label);
  }
  return file;
}

}  // namespace acinus::image
