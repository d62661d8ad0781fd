#pragma once
/// Compressed bytes.

#include <cstddef>
#include <string>
#include <string_view>

namespace acinus::imaging {

/// Content of a zlib stream, or of a gzip file of one or more members. Throws Error("<path>: ...")
/// if it is damaged, goes on behind its end, or holds another number of bytes than `size`.
std::string inflate_bytes(const std::string& path, std::string_view stream, std::size_t size);

/// A zlib stream, or with `gzip` one as the program of that name writes it.
std::string deflate_bytes(std::string_view bytes, bool gzip);

}  // namespace acinus::imaging
