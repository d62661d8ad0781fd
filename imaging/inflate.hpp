#pragma once
/// Compression and decompression by zlib.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace acinus::imaging {

/// Decompression, piece by piece, of a zlib stream or of a gzip file of one or more members. All
/// throw Error("<place>: ...") if the stream is damaged, ends early or continues beyond its size.
class Inflater {
 public:
  /// Source of the stream: writes its next bytes and returns their number, 0 at the end.
  using Source = std::function<std::size_t(std::span<char>)>;

  /// @param size  bytes of the content
  Inflater(std::string place, std::uint64_t size, Source source);
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater();

  /// Fills a piece with the next bytes of the content.
  void read(std::span<char> out);
  /// Checks that the stream ends where the content does.
  void finish();

 private:
  struct Stream;
  std::size_t inflate_into(std::span<char> out);
  bool fill_input(std::size_t least);
  bool starts_member();

  std::string place_;
  std::uint64_t size_, made_ = 0, taken_ = 0;
  Source source_;
  std::unique_ptr<Stream> stream_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of the bytes in the buffer that are not taken yet
};

/// Content of such a stream in memory.
std::string inflate_bytes(const std::string& place, std::string_view stream, std::size_t size);

/// Compressed bytes as a zlib stream, or as a gzip file.
std::string deflate_bytes(std::string_view bytes, bool gzip);

}  // namespace acinus::imaging
