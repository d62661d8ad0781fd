#pragma once
/// Chunks of zarr arrays in local folders, read and decoded one by one.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imaging/zarr_array.hpp"

namespace acinus::imaging {

/// Decoded chunk, whole: also where it reaches beyond the array.
struct ZarrChunk {
  std::vector<std::int64_t> first;  ///< indices of its first number in the array
  std::string place;                ///< file, for messages
  std::string bytes;
};

/// Calls visit for every chunk that is stored, by several threads at once. Chunks that differ along
/// one axis only come one after the other, ascending; all others in no order.
/// @param fixed    by axis: the only index that is asked for; nothing: all
/// @param ordered  that axis
/// @return number of chunks visited
/// Throws Error at files that cannot be read, damaged chunks and shards, and whatever visit throws.
std::int64_t visit_chunks(const ZarrArray& array,
                          std::span<const std::optional<std::int64_t>> fixed, std::size_t ordered,
                          const std::function<void(const ZarrChunk&)>& visit);

/// Distances of neighbouring numbers of a chunk along each axis, bytes.
std::vector<std::size_t> chunk_strides(const ZarrArray& array);

}  // namespace acinus::imaging
