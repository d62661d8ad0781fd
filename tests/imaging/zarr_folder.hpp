#pragma once
/// Folders of OME-Zarr, written for tests: any version, codec, order of axes and of bytes.

#include <blosc.h>
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "imaging/inflate.hpp"
#include "imaging/label_image.hpp"
#include "imaging/zarr_codecs.hpp"

namespace acinus::imaging {

/// Form in which an image is written.
struct ZarrForm {
  int version = 3;                           ///< of zarr: 2 has OME-Zarr 0.4, 3 has 0.5
  std::string axes = "zyx";                  ///< a letter an axis
  std::vector<std::int64_t> length{};        ///< of axes c and t, in their order in `axes`
  std::vector<std::int64_t> chunk{3, 2, 4};  ///< of z, y, x; 1 along other axes
  std::vector<std::int64_t> inner{};         ///< chunks of a shard, of z, y, x; empty: no shards
  std::string codec{};                       ///< "", gzip, zlib, zstd, blosc; with "+sum": crc32c
  std::string type = "uint16";               ///< name of version 3
  bool big = false, reversed = false;        ///< byte order; order F
  bool index_first = false;                  ///< index of a shard before its chunks
  char separator = '/';
  std::string unit = "micrometer";
  std::string steps{};        ///< "scale" of the level; "": the sides of the voxels
  std::string image_steps{};  ///< coordinateTransformations of the image; "": none
  std::string fill = "0";
  bool skip_zeros = false;  ///< chunks of zeros are not written
};

namespace zarr {

inline void write_file(const std::string& path, const std::string& content) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << content;
}

inline std::string list_of(const std::vector<std::int64_t>& all) {
  return fmt::format("[{}]", fmt::join(all, ", "));
}

inline int bytes_of_type(const std::string& type) {
  return type.ends_with("64") ? 8 : type.ends_with("32") ? 4 : type.ends_with("16") ? 2 : 1;
}

inline std::string number(double value, const std::string& type, bool big) {
  std::string out(bytes_of_type(type), '\0');
  if (type == "float64") {
    std::memcpy(out.data(), &value, 8);
  } else if (type == "float32") {
    const auto v = static_cast<float>(value);
    std::memcpy(out.data(), &v, 4);
  } else {
    const auto v = static_cast<std::int64_t>(value);
    std::memcpy(out.data(), &v, out.size());
  }
  if (big) std::ranges::reverse(out);
  return out;
}

inline std::string encode(const std::string& raw, const std::string& codec, int item) {
  std::string out = raw;
  if (codec.starts_with("gzip") || codec.starts_with("zlib"))
    out = deflate_bytes(raw, codec.starts_with("gzip"));
  if (codec.starts_with("zstd")) {
    out.resize(ZSTD_compressBound(raw.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), raw.data(), raw.size(), 3));
  }
  if (codec.starts_with("blosc")) {
    out.resize(raw.size() + BLOSC_MAX_OVERHEAD);
    out.resize(blosc_compress_ctx(5, BLOSC_SHUFFLE, item, raw.size(), raw.data(), out.data(),
                                  out.size(), "lz4", 0, 1));
  }
  if (codec.ends_with("sum")) out += number(crc32c(out), "uint32", false);
  return out;
}

/// Array of an image by indices along its axes.
class Writer {
 public:
  Writer(const LabelImage& image, const ZarrForm& form) : image_(image), f_(form) {
    std::size_t other = 0;
    for (const char c : f_.axes) {
      const bool space = c >= 'x' && c <= 'z';
      const std::size_t k = 2 - static_cast<std::size_t>(c - 'x');
      shape_.push_back(space ? image.size[c - 'x'] : f_.length.at(other++));
      chunk_.push_back(space ? f_.chunk[k] : 1);
      inner_.push_back(!space ? 1 : f_.inner.empty() ? f_.chunk[k] : f_.inner[k]);
    }
  }

  void write(const std::string& folder) const {
    write_file(folder + (f_.version == 2 ? "/.zarray" : "/zarr.json"),
               f_.version == 2 ? text_v2() : text_v3());
    std::vector<std::int64_t> blocks;
    for (std::size_t k = 0; k < shape_.size(); ++k)
      blocks.push_back((shape_[k] + chunk_[k] - 1) / chunk_[k]);
    each(blocks, [&](const std::vector<std::int64_t>& at) {
      std::vector<std::int64_t> first = at;
      for (std::size_t k = 0; k < at.size(); ++k) first[k] *= chunk_[k];
      const std::string raw = block(first, chunk_);
      if (f_.skip_zeros && raw.find_first_not_of('\0') == raw.npos) return;
      std::string key = f_.version == 2 ? "" : "c";
      for (const std::int64_t k : at)
        key += (key.empty() ? "" : std::string(1, f_.separator)) + std::to_string(k);
      write_file(folder + "/" + key, f_.inner.empty() ? packed(raw) : shard(first));
    });
  }

 private:
  template <class Visit>
  static void each(const std::vector<std::int64_t>& count, const Visit& visit) {
    std::int64_t n = 1;
    for (const std::int64_t c : count) n *= c;
    for (std::int64_t k = 0; k < n; ++k) {
      std::vector<std::int64_t> at(count.size());
      std::int64_t rest = k;
      for (std::size_t a = at.size(); a-- > 0; rest /= count[a]) at[a] = rest % count[a];
      visit(at);
    }
  }

  /// Label of a voxel, 1000 more for every channel and 10000 for every time; 0 beyond the array.
  double value(const std::vector<std::int64_t>& at) const {
    Voxel v{};
    double more = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (at[k] >= shape_[k]) return 0;
      const char c = f_.axes[k];
      if (c >= 'x' && c <= 'z') v[c - 'x'] = static_cast<int>(at[k]);
      if (c == 'c') more += 1000.0 * static_cast<double>(at[k]);
      if (c == 't') more += 10000.0 * static_cast<double>(at[k]);
    }
    return image_.label[image_.index(v)] + more;
  }

  std::string block(const std::vector<std::int64_t>& first,
                    const std::vector<std::int64_t>& length) const {
    std::vector<std::int64_t> count = length;
    if (f_.reversed) std::ranges::reverse(count);
    std::string raw;
    each(count, [&](std::vector<std::int64_t> at) {
      if (f_.reversed) std::ranges::reverse(at);
      for (std::size_t k = 0; k < at.size(); ++k) at[k] += first[k];
      raw += number(value(at), f_.type, f_.big);
    });
    return raw;
  }

  std::string packed(const std::string& raw) const {
    return encode(raw, f_.codec, bytes_of_type(f_.type));
  }

  std::string shard(const std::vector<std::int64_t>& origin) const {
    std::vector<std::int64_t> count;
    std::int64_t n = 1;
    for (std::size_t k = 0; k < chunk_.size(); ++k) {
      count.push_back(chunk_[k] / inner_[k]);
      n *= count.back();
    }
    std::string data, index;
    const std::int64_t before = f_.index_first ? 16 * n + 4 : 0;
    each(count, [&](const std::vector<std::int64_t>& at) {
      std::vector<std::int64_t> first = origin;
      for (std::size_t k = 0; k < at.size(); ++k) first[k] += at[k] * inner_[k];
      const std::string raw = block(first, inner_);
      if (raw.find_first_not_of('\0') == raw.npos) {
        index += std::string(16, '\xff');
        return;
      }
      const std::string bytes = packed(raw);
      const auto from = static_cast<std::int64_t>(data.size()) + before;
      std::string entry(16, '\0');
      const auto size = static_cast<std::int64_t>(bytes.size());
      std::memcpy(entry.data(), &from, 8);
      std::memcpy(entry.data() + 8, &size, 8);
      index += entry;
      data += bytes;
    });
    index = encode(index, "+sum", 8);
    return f_.index_first ? index + data : data + index;
  }

  std::string text_v2() const {
    const bool one = bytes_of_type(f_.type) == 1;
    const char kind = f_.type[0] == 'f'   ? 'f'
                      : f_.type[0] == 'i' ? 'i'
                      : f_.type[0] == 'b' ? 'b'
                                          : 'u';
    return fmt::format(
        R"({{"zarr_format": 2, "shape": {}, "chunks": {}, "dtype": "{}{}{}", "fill_value": {}, )"
        R"("order": "{}", "filters": null, "compressor": {}{}}})",
        list_of(shape_), list_of(chunk_),
        one      ? '|'
        : f_.big ? '>'
                 : '<',
        kind, bytes_of_type(f_.type), f_.fill, f_.reversed ? 'F' : 'C',
        f_.codec.empty() ? "null" : fmt::format(R"({{"id": "{}", "level": 1}})", f_.codec),
        f_.separator == '.' ? "" : R"(, "dimension_separator": "/")");
  }

  std::string codecs() const {
    std::string text;
    if (f_.reversed) {
      std::vector<std::int64_t> order;
      for (std::size_t k = shape_.size(); k-- > 0;) order.push_back(static_cast<std::int64_t>(k));
      text = fmt::format(R"({{"name": "transpose", "configuration": {{"order": {}}}}}, )",
                         list_of(order));
    }
    text += fmt::format(R"({{"name": "bytes", "configuration": {{"endian": "{}"}}}})",
                        f_.big ? "big" : "little");
    const std::string name = f_.codec.substr(0, f_.codec.find('+'));
    if (!name.empty()) text += fmt::format(R"(, {{"name": "{}", "configuration": {{}}}})", name);
    if (f_.codec.ends_with("sum")) text += R"(, {"name": "crc32c"})";
    return "[" + text + "]";
  }

  std::string text_v3() const {
    const std::string all =
        f_.inner.empty()
            ? codecs()
            : fmt::format(
                  R"([{{"name": "sharding_indexed", "configuration": {{"chunk_shape": {}, )"
                  R"("codecs": {}, "index_codecs": [{{"name": "bytes", "configuration": )"
                  R"({{"endian": "little"}}}}, {{"name": "crc32c"}}], "index_location": "{}"}}}}])",
                  list_of(inner_), codecs(), f_.index_first ? "start" : "end");
    return fmt::format(
        R"({{"zarr_format": 3, "node_type": "array", "shape": {}, "data_type": "{}", )"
        R"("chunk_grid": {{"name": "regular", "configuration": {{"chunk_shape": {}}}}}, )"
        R"("chunk_key_encoding": {{"name": "default", "configuration": {{"separator": "{}"}}}}, )"
        R"("fill_value": {}, "codecs": {}, "attributes": {{}}}})",
        list_of(shape_), f_.type, list_of(chunk_), f_.separator, f_.fill, all);
  }

  const LabelImage& image_;
  const ZarrForm& f_;
  std::vector<std::int64_t> shape_, chunk_, inner_;
};

}  // namespace zarr

/// Writes the metadata of a group; `ome` is the content of its object.
inline void write_group(const std::string& folder, int version, const std::string& ome) {
  if (version == 2) {
    zarr::write_file(folder + "/.zgroup", R"({"zarr_format": 2})");
    zarr::write_file(folder + "/.zattrs", "{" + ome + "}");
  } else {
    zarr::write_file(folder + "/zarr.json",
                     R"({"zarr_format": 3, "node_type": "group", "attributes": {"ome": )"
                     R"({"version": "0.5", )" +
                         ome + "}}}");
  }
}

/// OME's description of an image with the given levels, each with its scale.
inline std::string multiscales(const ZarrForm& form, const std::vector<std::string>& path,
                               const std::vector<std::string>& scale) {
  std::string axes, datasets;
  for (const char c : form.axes) {
    const std::string type = c == 'c' ? "channel" : c == 't' ? "time" : "space";
    axes += fmt::format(
        R"({}{{"name": "{}", "type": "{}"{}}})", axes.empty() ? "" : ", ", c, type,
        type == "space" && !form.unit.empty() ? fmt::format(R"(, "unit": "{}")", form.unit) : "");
  }
  for (std::size_t k = 0; k < path.size(); ++k)
    datasets += fmt::format(
        R"({}{{"path": "{}"{}}})", datasets.empty() ? "" : ", ", path[k],
        scale[k].empty()
            ? ""
            : fmt::format(R"(, "coordinateTransformations": [{{"type": "scale", "scale": {}}}])",
                          scale[k]));
  return fmt::format(
      R"("multiscales": [{{{}"axes": [{}], "datasets": [{}]{}}}], "image-label": {{}})",
      form.version == 2 ? R"("version": "0.4", )" : "", axes, datasets,
      form.image_steps.empty() ? "" : R"(, "coordinateTransformations": )" + form.image_steps);
}

inline std::string scale_of(const LabelImage& image, const ZarrForm& form) {
  std::string text;
  for (const char c : form.axes)
    text += fmt::format("{}{}", text.empty() ? "" : ", ",
                        c >= 'x' && c <= 'z' ? image.voxel[c - 'x'] : 1.0);
  return "[" + text + "]";
}

/// Writes a label image of one level.
inline void write_zarr(const std::string& folder, const LabelImage& image, const ZarrForm& form) {
  std::filesystem::remove_all(folder);
  write_group(folder, form.version,
              multiscales(form, {"0"}, {form.steps.empty() ? scale_of(image, form) : form.steps}));
  zarr::Writer(image, form).write(folder + "/0");
}

}  // namespace acinus::imaging
