#pragma once
/// Compression and decompression by zlib.

#include <cstddef>
#include <string>
#include <string_view>

namespace acinus::imaging {

/// Content of a zlib stream, or of a gzip file of one or more members. Throws Error("<path>: ...")
/// if it is damaged, continues beyond its end, or has another number of bytes than `size`.
std::string inflate_bytes(const std::string& path, std::string_view stream, std::size_t size);

/// Compressed bytes as a zlib stream, or as a gzip file.
std::string deflate_bytes(std::string_view bytes, bool gzip);

}  // namespace acinus::imaging
