#include "imaging/zarr_array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace acinus::imaging {
namespace {

constexpr const char* kCodecs = "gzip, zlib, zstd, blosc and crc32c are read, or none";

/// Type of the numbers of version 2, as "<u2".
Scalar take_type_v2(const JsonPart& place, bool& swap) {
  constexpr std::array<std::pair<const char*, Scalar>, 11> kTypes{{{"u1", Scalar::kU8},
                                                                   {"b1", Scalar::kU8},
                                                                   {"i1", Scalar::kI8},
                                                                   {"u2", Scalar::kU16},
                                                                   {"i2", Scalar::kI16},
                                                                   {"u4", Scalar::kU32},
                                                                   {"i4", Scalar::kI32},
                                                                   {"u8", Scalar::kU64},
                                                                   {"i8", Scalar::kI64},
                                                                   {"f4", Scalar::kF32},
                                                                   {"f8", Scalar::kF64}}};
  const std::string name = place.text();
  for (const auto& [text, type] : kTypes) {
    if (name.size() != 3 || name.substr(1) != text) continue;
    if (name[0] != '<' && name[0] != '>' && (name[0] != '|' || bytes_of(type) > 1)) break;
    swap = name[0] != '|' && (name[0] == '>') != (std::endian::native == std::endian::big);
    return type;
  }
  place.fail(
      "numbers are |u1, and <u2, >i4 and so on: b, u, i, f with 1 to 8 bytes, and < or > for the "
      "byte order. Save the labels as whole numbers");
}

void check_filters(const JsonPart& root) {
  if (!root.has("filters") || root.at("filters").is_null()) return;
  for (const JsonPart& filter : root.at("filters").items())
    filter.at("id").fail("filters are not read. Save the labels with a compressor only");
}

}  // namespace

ZarrCodec zarr_codec(const JsonPart& place, const std::string& name) {
  if (name == "gzip" || name == "zlib") return ZarrCodec::kGzip;
  if (name == "zstd") return ZarrCodec::kZstd;
  if (name == "blosc") return ZarrCodec::kBlosc;
  if (name == "crc32c") return ZarrCodec::kCrc32c;
  place.fail(fmt::format("{}. Save the image with one of these", kCodecs));
}

std::optional<Label> fill_label(const JsonPart& place) {
  if (place.is_null()) return 0;
  if (place.is_boolean()) return place.boolean() ? 1 : 0;
  if (!place.is_number()) return std::nullopt;
  const double v = place.number();
  if (!(v >= 0 && v <= std::numeric_limits<Label>::max() && v == std::floor(v)))
    return std::nullopt;
  return static_cast<Label>(v);
}

ZarrArray read_zarr_v2(const std::string& folder) {
  const JsonFile file = JsonFile::read(folder + "/.zarray");
  const JsonPart root = file.root();
  if (root.at("zarr_format").number() != 2)
    root.at("zarr_format").fail("2 is needed in a file .zarray");
  ZarrArray a;
  a.folder = folder;
  a.shape = root.at("shape").counts(0);
  a.chunk = root.at("chunks").counts(1);
  a.type = take_type_v2(root.at("dtype"), a.encoding.swap);
  a.fill = fill_label(root.at("fill_value"));
  a.encoding.order.resize(a.shape.size());
  std::iota(a.encoding.order.begin(), a.encoding.order.end(), 0);
  const JsonPart order = root.at("order");
  if (order.text() != "C" && order.text() != "F") order.fail("C or F is needed");
  if (order.text() == "F") std::ranges::reverse(a.encoding.order);
  if (root.has("dimension_separator")) {
    const JsonPart s = root.at("dimension_separator");
    if (s.text() != "." && s.text() != "/") s.fail("\".\" or \"/\" is needed");
    a.separator = s.text()[0];
  }
  check_filters(root);
  const JsonPart compressor = root.at("compressor");
  if (!compressor.is_null())
    a.encoding.codec = {zarr_codec(compressor.at("id"), compressor.at("id").text())};
  return a;
}

ZarrArray read_zarr_array(const std::string& folder) {
  const bool third = std::filesystem::is_regular_file(folder + "/zarr.json");
  check(third || std::filesystem::is_regular_file(folder + "/.zarray"),
        fmt::format("{}: holds neither zarr.json nor .zarray, so it is no array of zarr. The image "
                    "is incomplete, or its metadata name another place; copy or write it again.",
                    folder));
  ZarrArray a = third ? read_zarr_v3(folder) : read_zarr_v2(folder);
  const std::string file = folder + (third ? "/zarr.json" : "/.zarray");
  check(
      a.shape.size() == a.chunk.size() && a.shape.size() == a.file_length().size(),
      fmt::format("{}: shape has {} axes, its chunks {}; both must have the same. Write the image "
                  "again.",
                  file, a.shape.size(), a.chunk.size()));
  double bytes = static_cast<double>(bytes_of(a.type)), files = 1, inner = 1;
  for (std::size_t k = 0; k < a.shape.size(); ++k) {
    bytes *= static_cast<double>(a.chunk[k]);
    files *= std::ceil(static_cast<double>(a.shape[k]) / static_cast<double>(a.file_length()[k]));
    inner *= static_cast<double>(a.file_length()[k]) / static_cast<double>(a.chunk[k]);
    check(a.file_length()[k] % a.chunk[k] == 0,
          fmt::format("{}: shards of {} along axis {} do not hold whole chunks of {}. Write the "
                      "image again.",
                      file, a.file_length()[k], k, a.chunk[k]));
  }
  constexpr double kMostFiles = 1 << 24;
  check(bytes <= static_cast<double>(kMostChunkBytes),
        fmt::format("{}: chunks of {:.3g} bytes; at most {} are read. Write the image with smaller "
                    "chunks.",
                    file, bytes, kMostChunkBytes));
  check(files <= kMostFiles && inner <= kMostFiles,
        fmt::format("{}: {:.3g} files of {:.3g} chunks; at most {:.0f} of each are read. Write the "
                    "image with larger chunks.",
                    file, files, inner, kMostFiles));
  return a;
}

}  // namespace acinus::imaging
