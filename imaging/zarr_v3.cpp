/// Metadata of arrays of zarr version 3: chunk grid, keys of chunks, codecs, shards.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "imaging/zarr_array.hpp"

namespace acinus::imaging {
namespace {

Scalar type_of_v3(const JsonPart& place) {
  constexpr std::array<std::pair<const char*, Scalar>, 11> kTypes{{{"bool", Scalar::kU8},
                                                                   {"uint8", Scalar::kU8},
                                                                   {"int8", Scalar::kI8},
                                                                   {"uint16", Scalar::kU16},
                                                                   {"int16", Scalar::kI16},
                                                                   {"uint32", Scalar::kU32},
                                                                   {"int32", Scalar::kI32},
                                                                   {"uint64", Scalar::kU64},
                                                                   {"int64", Scalar::kI64},
                                                                   {"float32", Scalar::kF32},
                                                                   {"float64", Scalar::kF64}}};
  const std::string name = place.text();
  for (const auto& [text, type] : kTypes)
    if (name == text) return type;
  place.fail(
      "uint8 to uint64, int8 to int64, bool, float32 and float64 are read. Save the labels as "
      "whole numbers");
}

/// Name of a codec, grid or key encoding: {"name": ...}, or the name alone.
std::string name_of(const JsonPart& p) { return p.is_text() ? p.text() : p.at("name").text(); }

JsonPart name_place(const JsonPart& p) { return p.is_text() ? p : p.at("name"); }

void take_keys(const JsonPart& p, ZarrArray& a) {
  const std::string name = name_of(p);
  if (name != "default" && name != "v2") name_place(p).fail("\"default\" or \"v2\" is needed");
  a.prefix = name == "default" ? "c" : "";
  a.separator = name == "default" ? '/' : '.';
  if (p.is_text() || !p.has("configuration") || !p.at("configuration").has("separator")) return;
  const JsonPart s = p.at("configuration").at("separator");
  if (s.text() != "." && s.text() != "/") s.fail("\".\" or \"/\" is needed");
  a.separator = s.text()[0];
}

/// Byte order of the codec "bytes". @param bytes  of a number
bool is_swapped(const JsonPart& codec, std::size_t bytes) {
  const bool stated =
      codec.is_object() && codec.has("configuration") && codec.at("configuration").has("endian");
  if (!stated) {
    if (bytes > 1) codec.fail("numbers of several bytes need \"endian\": little or big");
    return false;
  }
  const JsonPart endian = codec.at("configuration").at("endian");
  if (endian.text() != "little" && endian.text() != "big") endian.fail("little or big is needed");
  return (endian.text() == "big") != (std::endian::native == std::endian::big);
}

/// Reorders the axes as a codec "transpose" does.
void transpose(const JsonPart& codec, std::vector<std::size_t>& order) {
  const JsonPart place = codec.at("configuration").at("order");
  if (!place.is_list()) place.fail("a list of all axes is needed");
  const std::vector<std::int64_t> said = place.counts(0);
  std::vector<std::int64_t> sorted = said, all(order.size());
  std::iota(all.begin(), all.end(), 0);
  std::ranges::sort(sorted);
  if (sorted != all) place.fail(fmt::format("a list of all {} axes is needed", order.size()));
  std::vector<std::size_t> after;
  for (const std::int64_t k : said) after.push_back(order[k]);
  order = after;
}

void take_codecs(const JsonPart& list, ZarrArray& a);

void take_shards(const JsonPart& codec, bool alone, ZarrArray& a) {
  if (!alone || a.shards)
    name_place(codec).fail(
        "shards are read without another codec around them. Write the image "
        "with one level of shards");
  const JsonPart how = codec.at("configuration");
  ZarrShards s;
  s.length = std::exchange(a.chunk, how.at("chunk_shape").counts(1));
  if (how.has("index_location")) {
    const JsonPart at = how.at("index_location");
    if (at.text() != "start" && at.text() != "end") at.fail("start or end is needed");
    s.at_end = at.text() == "end";
  }
  ZarrArray index;  // a codec list of the same form
  index.type = Scalar::kU64;
  take_codecs(how.at("index_codecs"), index);
  const std::vector<ZarrCodec>& codecs = index.encoding.codec;
  if (index.shards || codecs.size() > 1 || (!codecs.empty() && codecs[0] != ZarrCodec::kCrc32c))
    how.at("index_codecs").fail("\"bytes\", with or without \"crc32c\", is needed");
  s.has_sum = !codecs.empty();
  s.swap = index.encoding.swap;
  a.shards = s;
  take_codecs(how.at("codecs"), a);
}

void take_codecs(const JsonPart& list, ZarrArray& a) {
  bool in_bytes = false;
  const std::vector<JsonPart> items = list.items();
  for (const JsonPart& codec : items) {
    const std::string name = name_of(codec);
    if (name == "sharding_indexed") return take_shards(codec, items.size() == 1, a);
    if (!in_bytes && name == "transpose") {
      transpose(codec, a.encoding.order);
    } else if (!in_bytes && name == "bytes") {
      a.encoding.swap = is_swapped(codec, bytes_of(a.type));
      in_bytes = true;
    } else {
      const ZarrCodec read = zarr_codec(name_place(codec), name);
      if (!in_bytes) name_place(codec).fail("\"bytes\" must come before codecs of bytes");
      a.encoding.codec.push_back(read);
    }
  }
  if (!in_bytes) list.fail("the codec \"bytes\" is needed");
}

void check_names(const JsonPart& root) {
  constexpr std::array kKnown{
      "zarr_format",         "node_type",  "shape",  "data_type",  "chunk_grid",
      "chunk_key_encoding",  "fill_value", "codecs", "attributes", "dimension_names",
      "storage_transformers"};
  for (const std::string& name : root.names()) {
    if (std::ranges::find(kKnown, name) != kKnown.end()) continue;
    const JsonPart extra = root.at(name);
    const bool optional =
        extra.is_object() && extra.has("must_understand") && !extra.at("must_understand").boolean();
    if (!optional) extra.fail("is an extension of zarr that is not read. Write the image without");
  }
  if (root.has("storage_transformers") && !root.at("storage_transformers").items().empty())
    root.at("storage_transformers").fail("storage transformers are not read");
}

}  // namespace

ZarrArray read_zarr_v3(const std::string& folder) {
  const JsonFile file = JsonFile::read(folder + "/zarr.json");
  const JsonPart root = file.root();
  if (root.at("zarr_format").number() != 3)
    root.at("zarr_format").fail("3 is needed in a file zarr.json");
  if (root.at("node_type").text() != "array") root.at("node_type").fail("an array is needed here");
  check_names(root);
  ZarrArray a;
  a.folder = folder;
  a.shape = root.at("shape").counts(0);
  const JsonPart grid = root.at("chunk_grid");
  if (name_of(grid) != "regular") name_place(grid).fail("a regular grid of chunks is needed");
  a.chunk = grid.at("configuration").at("chunk_shape").counts(1);
  a.type = type_of_v3(root.at("data_type"));
  take_keys(root.at("chunk_key_encoding"), a);
  a.fill = fill_label(root.at("fill_value"));
  a.encoding.order.resize(a.shape.size());
  std::iota(a.encoding.order.begin(), a.encoding.order.end(), 0);
  take_codecs(root.at("codecs"), a);
  if (root.has("dimension_names") && !root.at("dimension_names").is_null())
    for (const JsonPart& n : root.at("dimension_names").items())
      a.axis.push_back(n.is_null() ? "" : n.text());
  return a;
}

}  // namespace acinus::imaging
