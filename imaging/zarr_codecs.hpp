#pragma once
/// Compression and checksums of the chunks of zarr arrays.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace acinus::imaging {

enum class ZarrCodec { kGzip, kZstd, kBlosc, kCrc32c };  ///< zlib counts as kGzip

/// Checksum CRC-32C (Castagnoli) of bytes.
std::uint32_t crc32c(std::string_view bytes);

/// Undoes codecs, the last first.
/// @param place  of the bytes, for messages
/// @param size   bytes that must come out; at most kMostChunkBytes
/// Throws Error where bytes are damaged, a checksum differs, or another number of bytes comes out.
std::string undo_codecs(const std::string& place, std::span<const ZarrCodec> codecs,
                        std::string bytes, std::size_t size);

inline constexpr std::size_t kMostChunkBytes = (std::size_t{1} << 31) - 17;  ///< Blosc's limit

}  // namespace acinus::imaging
