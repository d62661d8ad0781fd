#pragma once
/// Compressed bytes.

#include <cstddef>
#include <string>
#include <string_view>

namespace acinus::image {

/// What a zlib or gzip stream holds. Throws Error("<path>: ...") if it is damaged or holds another
/// number of bytes than `size`.
std::string inflate_bytes(const std::string& path, std::string_view stream, std::size_t size);

/// A zlib stream, or with `gzip` one as the program of that name writes it.
std::string deflate_bytes(std::string_view bytes, bool gzip);

}  // namespace acinus::image
