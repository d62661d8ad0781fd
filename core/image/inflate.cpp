#include "core/image/inflate.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "core/error.hpp"

namespace acinus::image {
namespace {

// For windowBits of zlib: largest window; either header is found by itself, or gzip's is written.
constexpr int kAnyHeader = MAX_WBITS + 32, kGzipHeader = MAX_WBITS + 16;
constexpr std::size_t kMostAtOnce = std::numeric_limits<uInt>::max();

Bytef* writable(const char* p) {  // zlib does not write what it reads, but says so in C
  return reinterpret_cast<Bytef*>(const_cast<char*>(p));
}

}  // namespace

std::string inflate_bytes(const std::string& path, std::string_view stream, std::size_t size) {
  z_stream z{};
  if (inflateInit2(&z, kAnyHeader) != Z_OK) throw std::bad_alloc();
  // One byte more than asked for tells a stream that is too long.
  std::string out(size + 1, '\0');
  std::size_t taken = 0, made = 0;
  int status = Z_OK;
  while (status == Z_OK) {
    const std::size_t in = std::min(stream.size() - taken, kMostAtOnce);
    const std::size_t room = std::min(out.size() - made, kMostAtOnce);
    z.next_in = writable(stream.data() + taken);
    z.avail_in = static_cast<uInt>(in);
    z.next_out = writable(out.data() + made);
    z.avail_out = static_cast<uInt>(room);
    status = inflate(&z, Z_NO_FLUSH);
    taken += in - z.avail_in;
    made += room - z.avail_out;
  }
  inflateEnd(&z);
  check(status == Z_STREAM_END || status == Z_BUF_ERROR,
        fmt::format("{}: the compressed data are damaged near byte {} of them. Write the file "
                    "again.",
                    path, taken));
  check(made == size,
        fmt::format("{}: the compressed data hold {} bytes where {} are announced. The file is "
                    "truncated, or its sizes or type are wrong.",
                    path, made > size ? "more" : fmt::format("{}", made), size));
  out.resize(size);
  return out;
}

std::string deflate_bytes(std::string_view bytes, bool gzip) {
  constexpr int kMemory = 8;  // zlib's default
  z_stream z{};
  if (deflateInit2(&z, Z_BEST_SPEED, Z_DEFLATED, gzip ? kGzipHeader : MAX_WBITS, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out;
  std::string buffer(1 << 20, '\0');
  std::size_t taken = 0;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (z.avail_in == 0) {
      const std::size_t in = std::min(bytes.size() - taken, kMostAtOnce);
      z.next_in = writable(bytes.data() + taken);
      z.avail_in = static_cast<uInt>(in);
      taken += in;
    }
    z.next_out = writable(buffer.data());
    z.avail_out = static_cast<uInt>(buffer.size());
    status = deflate(&z, taken == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    out.append(buffer, 0, buffer.size() - z.avail_out);
  }
  deflateEnd(&z);
  return out;
}

}  // namespace acinus::image
