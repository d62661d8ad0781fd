#pragma once
/// Arrays of zarr, versions 2 and 3, in local folders: their metadata.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "imaging/scalar.hpp"
#include "imaging/zarr_codecs.hpp"
#include "imaging/zarr_json.hpp"

namespace acinus::imaging {

/// Encoding of the numbers of a chunk.
struct ZarrEncoding {
  bool swap = false;               ///< the other byte order than this machine's
  std::vector<std::size_t> order;  ///< axes of the array as stored, the slowest first
  std::vector<ZarrCodec> codec;    ///< in the order of writing
};

/// Index of a shard: a file of several chunks, each compressed on its own.
struct ZarrShards {
  std::vector<std::int64_t> length;  ///< numbers of a shard along each axis
  bool at_end = true, has_sum = false, swap = false;
};

/// Array as its metadata describe it. All lists have one entry an axis, in the order of the shape.
struct ZarrArray {
  std::string folder;
  std::vector<std::int64_t> shape;
  std::vector<std::int64_t> chunk;  ///< numbers of a chunk along each axis
  Scalar type = Scalar::kU8;
  std::optional<Label> fill;  ///< value of chunks that are not stored; nothing: is not a label
  std::string prefix;         ///< of the paths of files in the folder
  char separator = '.';       ///< between the numbers in such paths
  ZarrEncoding encoding;
  std::optional<ZarrShards> shards;
  std::vector<std::string> axis;  ///< names, version 3; empty: not stated

  const std::vector<std::int64_t>& file_length() const { return shards ? shards->length : chunk; }
};

/// Codec of that name. Throws Error at `place`, naming those that are read, at any other.
ZarrCodec zarr_codec(const JsonPart& place, const std::string& name);

/// Fill value as a label; nothing where it is not one. null is 0.
std::optional<Label> fill_label(const JsonPart& place);

/// Reads the metadata (.zarray, zarr.json) of an array. Throws Error at what is wrong or not read.
ZarrArray read_zarr_array(const std::string& folder);

// Parts of read_zarr_array, by version.
ZarrArray read_zarr_v2(const std::string& folder);
ZarrArray read_zarr_v3(const std::string& folder);

}  // namespace acinus::imaging
