#include "imaging/inflate.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

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

struct Inflater::Stream {
  z_stream z{};
  int status = Z_OK;
};

Inflater::Inflater(std::string place, std::uint64_t size, Source source)
    : place_(std::move(place)),
      size_(size),
      source_(std::move(source)),
      stream_(std::make_unique<Stream>()),
      buffer_(1 << 18, '\0') {
  if (inflateInit2(&stream_->z, kAnyHeader) != Z_OK) throw std::bad_alloc();
}

Inflater::~Inflater() { inflateEnd(&stream_->z); }

/// Reads on until the buffer has so many bytes. @return false at the end of the stream
bool Inflater::fill_input(std::size_t least) {
  while (end_ - begin_ < least) {
    buffer_.erase(0, begin_);
    buffer_.resize(buffer_.size() + begin_);
    end_ -= begin_;
    begin_ = 0;
    const std::size_t n = source_(std::span(buffer_).subspan(end_));
    if (n == 0) return false;
    end_ += n;
  }
  return true;
}

bool Inflater::starts_member() {
  return fill_input(2) && std::string_view(buffer_).substr(begin_).starts_with("\x1f\x8b");
}

/// Decompresses up to so many bytes. @return their number; fewer at the end, or at damage
std::size_t Inflater::inflate_into(std::span<char> out) {
  z_stream& z = stream_->z;
  int& status = stream_->status;
  std::size_t made = 0;
  while (status == Z_OK && made < out.size()) {
    const std::size_t in = fill_input(1) ? end_ - begin_ : 0;
    const std::size_t room = std::min(out.size() - made, kMostAtOnce);
    z.next_in = writable(buffer_.data() + begin_);
    z.avail_in = static_cast<uInt>(in);
    z.next_out = writable(out.data() + made);
    z.avail_out = static_cast<uInt>(room);
    status = inflate(&z, Z_NO_FLUSH);
    begin_ += in - z.avail_in;
    taken_ += in - z.avail_in;
    made += room - z.avail_out;
    if (status == Z_STREAM_END && starts_member()) status = inflateReset(&z);
  }
  made_ += made;
  check(status == Z_OK || status == Z_STREAM_END || status == Z_BUF_ERROR || made_ > size_,
        fmt::format("{}: the compressed data are damaged near byte {} of them. Write the file "
                    "again.",
                    place_, taken_));
  return made;
}

void Inflater::read(std::span<char> out) {
  const std::size_t n = inflate_into(out);
  check(n == out.size(),
        fmt::format("{}: the compressed data hold {} bytes where {} are announced. The file is "
                    "truncated, or its sizes or type are wrong.",
                    place_, made_, size_));
}

void Inflater::finish() {
  // One byte more than announced reveals a stream that is too long.
  char more = 0;
  check(inflate_into({&more, 1}) == 0,
        fmt::format("{}: the compressed data hold more bytes where {} are announced. The file is "
                    "truncated, or its sizes or type are wrong.",
                    place_, size_));
  std::size_t left = 0;
  bool zeros = true;
  for (; fill_input(1); begin_ = end_) {
    left += end_ - begin_;
    zeros = zeros && std::all_of(&buffer_[begin_], &buffer_[begin_] + (end_ - begin_),
                                 [](char c) { return c == '\0'; });
  }
  const bool ended = stream_->status == Z_STREAM_END;
  check(ended && zeros,
        fmt::format("{}: the compressed data {}. The file is truncated or damaged.", place_,
                    ended ? fmt::format("end {} bytes before the file", left) : "have no end"));
}

std::string inflate_bytes(const std::string& place, std::string_view stream, std::size_t size) {
  Inflater inflater(place, size, [&](std::span<char> out) {
    const std::size_t n = std::min(out.size(), stream.size());
    std::copy_n(stream.begin(), n, out.begin());
    stream.remove_prefix(n);
    return n;
  });
  // Grows with the bytes that are inflated: a header may announce any number.
  constexpr std::size_t kStart = 1 << 20;
  std::string out;
  while (out.size() < size) {
    const std::size_t made = out.size();
    out.resize(std::min(size, std::max(kStart, 2 * made)));
    inflater.read(std::span(out).subspan(made));
  }
  inflater.finish();
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
