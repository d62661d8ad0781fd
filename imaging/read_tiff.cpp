/// Reader of TIFF stacks, by libtiff: a page a slice.

#include <fmt/format.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "imaging/image_formats.hpp"
#include "imaging/tiff_chain.hpp"
#include "imaging/tiff_handle.hpp"
#include "imaging/tiff_text.hpp"

namespace acinus::imaging {
namespace {

std::string& last_words() {
  thread_local std::string words;
  return words;
}

/// Error handler of libtiff, which has one per process; keeps the message.
void keep_words(const char* module, const char* format, va_list values) {
  std::array<char, 400> text{};
  std::vsnprintf(text.data(), text.size(), format, values);
  last_words() = fmt::format("{}{}{}", module ? module : "", module ? ": " : "", text.data());
}

TiffFile open_tiff(const std::string& path) {
  check(std::filesystem::is_regular_file(path),
        fmt::format("{}: no such file. Check the path.", path));
  TIFFSetWarningHandler(nullptr);
  TIFFSetErrorHandler(keep_words);
  last_words().clear();
  // m: without a map of the file, whose pages would stay in memory.
  TiffFile tiff(TIFFOpen(path.c_str(), "rm"));
  check(tiff != nullptr, fmt::format("{}: cannot be read as TIFF: {}", path, last_words()));
  return tiff;
}

struct TiffPage {
  std::uint32_t width = 0, height = 0, depth = 1;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, compression = COMPRESSION_NONE;
  bool operator==(const TiffPage&) const = default;
};

TiffPage page_of(TIFF* t) {
  TiffPage p;
  TIFFGetField(t, TIFFTAG_IMAGEWIDTH, &p.width);
  TIFFGetField(t, TIFFTAG_IMAGELENGTH, &p.height);
  TIFFGetFieldDefaulted(t, TIFFTAG_IMAGEDEPTH, &p.depth);
  TIFFGetFieldDefaulted(t, TIFFTAG_BITSPERSAMPLE, &p.bits);
  TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLESPERPIXEL, &p.samples);
  TIFFGetFieldDefaulted(t, TIFFTAG_SAMPLEFORMAT, &p.format);
  TIFFGetFieldDefaulted(t, TIFFTAG_COMPRESSION, &p.compression);
  return p;
}

/// Throws Error at a lossy compression, which does not preserve labels.
void check_lossless(const std::string& path, const TiffPage& p) {
  constexpr std::array<std::pair<std::uint16_t, const char*>, 9> kLossy{
      {{COMPRESSION_JPEG, "JPEG"},
       {COMPRESSION_OJPEG, "JPEG"},
       {COMPRESSION_JP2000, "JPEG 2000"},
       {33003, "JPEG 2000"},
       {33005, "JPEG 2000"},
       {COMPRESSION_LERC, "LERC"},
       {COMPRESSION_WEBP, "WebP"},
       {22610, "JPEG XR"},
       {50002, "JPEG XL"}}};
  for (const auto& [code, name] : kLossy)
    check(p.compression != code,
          fmt::format("{}: compressed with {} (Compression {}), which changes numbers: labels are "
                      "lost at walls. Save the segmentation without compression, or with deflate "
                      "or LZW.",
                      path, name, code));
}

Scalar type_of(const std::string& path, const TiffPage& p) {
  check_lossless(path, p);
  check(p.depth <= 1, fmt::format("{}: {} slices in one page (ImageDepth), which is not read. Save "
                                  "a page a slice.",
                                  path, p.depth));
  check(p.samples == 1,
        fmt::format("{}: {} numbers a pixel (SamplesPerPixel): a colour picture, or channels in "
                    "one page. Save the labels themselves, one number a pixel.",
                    path, p.samples));
  const bool real = p.format == SAMPLEFORMAT_IEEEFP, with_sign = p.format == SAMPLEFORMAT_INT;
  check(real || with_sign || p.format == SAMPLEFORMAT_UINT || p.format == SAMPLEFORMAT_VOID,
        fmt::format("{}: numbers of the kind {} (SampleFormat) are not read; whole or real ones "
                    "are.",
                    path, p.format));
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

/// Reads the rows of a page, from its strips or tiles.
void read_page(const std::string& path, TIFF* t, const TiffPage& page, std::int64_t number,
               std::vector<std::byte>& rows) {
  const std::size_t bytes = page.bits / 8u, row = page.width * bytes;
  const auto damaged = [&] {
    return Error(fmt::format("{}: page {} cannot be read: {}. The file is truncated or damaged.",
                             path, number, last_words()));
  };
  if (TIFFIsTiled(t) == 0) {
    if (TIFFScanlineSize64(t) != row) throw damaged();
    for (std::uint32_t y = 0; y < page.height; ++y)
      if (TIFFReadScanline(t, rows.data() + y * row, y, 0) < 0) throw damaged();
    return;
  }
  std::uint32_t wide = 0, high = 0;
  TIFFGetField(t, TIFFTAG_TILEWIDTH, &wide);
  TIFFGetField(t, TIFFTAG_TILELENGTH, &high);
  constexpr std::uint32_t kMostTile = 1 << 14;
  if (wide == 0 || high == 0 || wide > kMostTile || high > kMostTile) throw damaged();
  check_announced(path, static_cast<double>(TIFFTileSize64(t)),
                  static_cast<double>(std::filesystem::file_size(path)), true);
  std::vector<std::byte> tile(TIFFTileSize64(t));
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

/// Side of a pixel along an axis, from its resolution in ImageJ's unit.
double pixel_size(TIFF* t, std::uint32_t tag) {
  float per_unit = 0;
  return TIFFGetField(t, tag, &per_unit) == 1 && per_unit > 0 ? 1 / static_cast<double>(per_unit)
                                                              : 0;
}

TiffText describe(const std::string& path, TIFF* t) {
  const char* description = nullptr;
  const bool has = TIFFGetField(t, TIFFTAG_IMAGEDESCRIPTION, &description) == 1 && description;
  TiffText text = read_tiff_text(path, has ? description : "");
  if (text.is_imagej) {
    text.step[0] = pixel_size(t, TIFFTAG_XRESOLUTION);
    text.step[1] = pixel_size(t, TIFFTAG_YRESOLUTION);
  }
  return text;
}

/// Throws Error unless the pages that the description states are there.
void check_pages(const std::string& path, const TiffPage& first, const TiffChain& chain,
                 TiffText& text) {
  const auto pages = static_cast<std::int64_t>(chain.page.size());
  check(chain.planes_in_first <= 1 || pages > 1,
        fmt::format("{}: {} slices in one page, as MetaMorph writes them, which is not read. Save "
                    "a page a slice.",
                    path, chain.planes_in_first));
  if (text.images > pages && pages == 1) {
    const double page = 1.0 * first.width * first.height * first.bits / 8;
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    check(size >= page * static_cast<double>(text.images),
          fmt::format("{}: its description speaks of {} pages, but there is 1, and the file is too "
                      "short for more. It is truncated or damaged.",
                      path, text.images));
    throw Error(
        fmt::format("{}: {} slices behind a single page, as ImageJ writes them beyond 4 GB "
                    "and tifffile if asked. Save it as OME-TIFF.",
                    path, text.images));
  }
  check(text.images == 0 || text.images == pages,
        fmt::format("{}: {} pages, but its description speaks of {}. The file is truncated or "
                    "damaged, or was edited: write it again.",
                    path, pages, text.images));
  if (text.slices == 0) text.slices = pages / (text.channels * text.times);
  check(text.planes() == pages,
        fmt::format("{}: {} pages, but its description speaks of {} slices, {} channels and {} "
                    "times. Parts may be in other files: write one file.",
                    path, pages, text.slices, text.channels, text.times));
  check((text.width == 0 || text.width == first.width) &&
            (text.height == 0 || text.height == first.height),
        fmt::format("{}: its pages have {} x {} pixels, its description says {} x {}. Write the "
                    "image again.",
                    path, first.width, first.height, text.width, text.height));
}

/// Adds notes about the meaning of rows and numbers that are ignored.
void note_page(TIFF* t, ImageFile& file) {
  std::uint16_t orientation = ORIENTATION_TOPLEFT, meaning = PHOTOMETRIC_MINISBLACK;
  TIFFGetFieldDefaulted(t, TIFFTAG_ORIENTATION, &orientation);
  TIFFGetField(t, TIFFTAG_PHOTOMETRIC, &meaning);
  if (orientation != ORIENTATION_TOPLEFT)
    file.note.push_back(
        fmt::format("the file says Orientation {}; rows are taken as stored, from "
                    "the top and the left",
                    orientation));
  if (meaning == PHOTOMETRIC_MINISWHITE)
    file.note.emplace_back("the file says that 0 is white; numbers are taken as stored, 0 outside");
}

/// Page of a slice of a channel.
std::int64_t page_number(const std::string& path, const TiffText& text, std::int64_t slice,
                         std::int64_t channel) {
  const std::int64_t plane = text.plane(slice, channel);
  if (text.page_of_plane.empty()) return plane;
  const std::int64_t page = text.page_of_plane[plane];
  check(page >= 0 && page < text.planes(),
        fmt::format("{}: slice {} of channel {} is {} by its OME description. Write one file with "
                    "all slices.",
                    path, slice, channel,
                    page == TiffText::kElsewhere ? std::string("in another file")
                    : page < 0                   ? std::string("in no page")
                               : fmt::format("page {} of {}", page, text.planes())));
  return page;
}

void open_page(const std::string& path, TIFF* t, std::uint64_t place, std::int64_t number,
               const TiffPage& first) {
  last_words().clear();
  check(TIFFSetSubDirectory(t, place) == 1,
        fmt::format("{}: page {} is damaged: {}", path, number, last_words()));
  const TiffPage page = page_of(t);
  check(page == first,
        fmt::format("{}: page {} has {} x {} pixels of {} bits, the first {} x {} of {}. All must "
                    "be alike, without thumbnails or pyramids; or the file is damaged.",
                    path, number, page.width, page.height, page.bits, first.width, first.height,
                    first.bits));
  std::uint32_t kind = 0;
  TIFFGetField(t, TIFFTAG_SUBFILETYPE, &kind);
  check((kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0,
        fmt::format("{}: page {} says that it is a smaller copy or a mask of another "
                    "(NewSubfileType {}). Export the stack without such pages.",
                    path, number, kind));
}

}  // namespace

ImageFile read_tiff(const std::string& path, const ChannelChoice& channel) {
  const TiffFile tiff = open_tiff(path);
  const TiffPage first = page_of(tiff.get());
  ImageFile file;
  file.type = type_of(path, first);
  TiffText text = describe(path, tiff.get());
  const TiffChain chain = read_tiff_chain(path, text.images > 0 || text.slices > 0);
  check_pages(path, first, chain, text);
  check(!text.type || bytes_of(*text.type) == bytes_of(file.type),
        fmt::format("{}: its pages hold numbers of {} bytes, its description says {}. Write the "
                    "image again.",
                    path, bytes_of(file.type), text.type ? bytes_of(*text.type) : 0));
  note_page(tiff.get(), file);
  file.size = {first.width, first.height, text.slices};
  check_stack(path, file.size, text.channels * text.times);
  const std::int64_t chosen = channel.among(path, text.channels * text.times);
  file.step = text.step;
  file.unit = text.unit;
  file.step_fault = text.step_fault;
  const std::size_t voxels = prepare_rows(path, file);
  check_announced(path, static_cast<double>(voxels * bytes_of(file.type)), chain.stored, true);
  std::vector<std::byte> rows(bytes_of(file.type) * first.width * first.height);
  for (std::int64_t slice = 0; slice < text.slices; ++slice) {
    const std::int64_t number = page_number(path, text, slice, chosen);
    open_page(path, tiff.get(), chain.page[number], number, first);
    read_page(path, tiff.get(), first, number, rows);
    append_lines(path, rows, false, static_cast<std::size_t>(slice * first.height), file);
  }
  return file;
}

}  // namespace acinus::imaging
