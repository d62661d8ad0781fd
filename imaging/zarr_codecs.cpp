#include "imaging/zarr_codecs.hpp"

#include <blosc.h>
#include <fmt/format.h>
#include <zstd.h>

#include <array>
#include <utility>

#include "core/error.hpp"
#include "imaging/inflate.hpp"

namespace acinus::imaging {
namespace {

[[noreturn]] void fail(const std::string& place, const std::string& found) {
  throw Error(
      fmt::format("{}: {}. The chunk is truncated or damaged; copy or write the image "
                  "again.",
                  place, found));
}

void check_size(const std::string& place, std::size_t found, std::size_t size) {
  if (found != size) fail(place, fmt::format("{} bytes where the chunk has {}", found, size));
}

std::string undo_zstd(const std::string& place, const std::string& bytes, std::size_t size) {
  // The content of a stream may have any length; one that states it is checked before memory is
  // reserved.
  const unsigned long long said = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (said == ZSTD_CONTENTSIZE_ERROR) fail(place, "no zstd data");
  if (said != ZSTD_CONTENTSIZE_UNKNOWN && said > size) check_size(place, said, size);
  std::string out(size, '\0');
  const std::size_t n = ZSTD_decompress(out.data(), size, bytes.data(), bytes.size());
  if (ZSTD_isError(n) != 0) fail(place, fmt::format("zstd says \"{}\"", ZSTD_getErrorName(n)));
  check_size(place, n, size);
  return out;
}

std::string undo_blosc(const std::string& place, const std::string& bytes, std::size_t size) {
  std::size_t said = 0;
  if (blosc_cbuffer_validate(bytes.data(), bytes.size(), &said) < 0)
    fail(place, fmt::format("no whole blosc buffer in {} bytes", bytes.size()));
  check_size(place, said, size);
  std::string out(size, '\0');
  const int n = blosc_decompress_ctx(bytes.data(), out.data(), size, 1);
  if (n < 0 || static_cast<std::size_t>(n) != size)
    fail(place, fmt::format("blosc cannot decompress it (code {})", n));
  return out;
}

std::string undo_crc32c(const std::string& place, std::string bytes) {
  constexpr std::size_t kSum = 4;
  if (bytes.size() < kSum) fail(place, fmt::format("{} bytes with a checksum of 4", bytes.size()));
  std::uint32_t said = 0;
  for (std::size_t k = 0; k < kSum; ++k)
    said |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[bytes.size() - kSum + k]))
            << 8 * k;
  bytes.resize(bytes.size() - kSum);
  const std::uint32_t found = crc32c(bytes);
  if (found != said)
    fail(place, fmt::format("checksum {:08x} where {:08x} is stored", found, said));
  return bytes;
}

}  // namespace

std::uint32_t crc32c(std::string_view bytes) {
  static const auto kTable = [] {
    constexpr std::uint32_t kCastagnoli = 0x82f63b78;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t k = 0; k < table.size(); ++k) {
      table[k] = k;
      for (int bit = 0; bit < 8; ++bit)
        table[k] = (table[k] >> 1) ^ ((table[k] & 1) != 0 ? kCastagnoli : 0);
    }
    return table;
  }();
  std::uint32_t sum = ~std::uint32_t{0};
  for (const char c : bytes)
    sum = (sum >> 8) ^ kTable[(sum ^ static_cast<unsigned char>(c)) & 0xff];
  return ~sum;
}

std::string undo_codecs(const std::string& place, std::span<const ZarrCodec> codecs,
                        std::string bytes, std::size_t size) {
  constexpr std::size_t kSum = 4;
  for (std::size_t k = codecs.size(); k-- > 0;) {
    // Checksums made before this codec are part of what it holds.
    std::size_t held = size;
    bool packed = false;
    for (std::size_t j = 0; j < k; ++j) {
      held += codecs[j] == ZarrCodec::kCrc32c ? kSum : 0;
      packed = packed || codecs[j] != ZarrCodec::kCrc32c;
    }
    check(!packed || codecs[k] == ZarrCodec::kCrc32c,
          fmt::format("{}: is compressed twice. Write the image with one codec.", place));
    if (codecs[k] == ZarrCodec::kGzip) bytes = inflate_bytes(place, bytes, held);
    if (codecs[k] == ZarrCodec::kZstd) bytes = undo_zstd(place, bytes, held);
    if (codecs[k] == ZarrCodec::kBlosc) bytes = undo_blosc(place, bytes, held);
    if (codecs[k] == ZarrCodec::kCrc32c) bytes = undo_crc32c(place, std::move(bytes));
  }
  check_size(place, bytes.size(), size);
  return bytes;
}

}  // namespace acinus::imaging
