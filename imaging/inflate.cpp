#include "imaging/inflate.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "core/error.hpp"

namespace acinus::imaging {
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
  constexpr std::size_t kStart = 1 << 20;
  // Grows with the bytes that are inflated: a header may announce any number. One byte more than
  // asked for reveals a stream that is too long.
  std::string out;
  std::size_t taken = 0, made = 0;
  int status = Z_OK;
  while (status == Z_OK) {
    if (made == out.size()) out.resize(std::min(size + 1, std::max(kStart, 2 * made)));
    const std::size_t in = std::min(stream.size() - taken, kMostAtOnce);
    const std::size_t room = std::min(out.size() - made, kMostAtOnce);
    z.next_in = writable(stream.data() + taken);
    z.avail_in = static_cast<uInt>(in);
    z.next_out = writable(out.data() + made);
    z.avail_out = static_cast<uInt>(room);
    status = inflate(&z, Z_NO_FLUSH);
    taken += in - z.avail_in;
    made += room - z.avail_out;
    const bool next_member = status == Z_STREAM_END && stream.substr(taken).starts_with("\x1f\x8b");
    if (next_member) status = inflateReset(&z);
    if (made > size) break;
  }
  inflateEnd(&z);
  check(status == Z_STREAM_END || status == Z_BUF_ERROR || made > size,
        fmt::format("{}: the compressed data are damaged near byte {} of them. Write the file "
                    "again.",
                    path, taken));
  check(made == size,
        fmt::format("{}: the compressed data hold {} bytes where {} are announced. The file is "
                    "truncated, or its sizes or type are wrong.",
                    path, made > size ? "more" : fmt::format("{}", made), size));
  check(status == Z_STREAM_END && stream.find_first_not_of('\0', taken) == stream.npos,
        fmt::format("{}: the compressed data {}. The file is truncated or damaged.", path,
                    status == Z_STREAM_END
                        ? fmt::format("end {} bytes before the file", stream.size() - taken)
                        : "have no end"));
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

}  // namespace acinus::imaging
