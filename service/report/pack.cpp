#include "service/report/pack.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace acinus::service {
namespace {

/// Appends integers as byte planes.
/// @param width  bytes per integer
void append_planes(std::string& bytes, const std::vector<std::uint32_t>& value, int width) {
  for (int plane = width - 1; plane >= 0; --plane)
    for (const std::uint32_t v : value) bytes += static_cast<char>((v >> (8 * plane)) & 0xff);
}

void append_float(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>((bits >> (8 * k)) & 0xff);
}

/// Appends minimum and maximum of the finite values.
/// @return levels from 0 to `steps` between them; steps + 1 for values that are not finite
std::vector<std::uint32_t> levels_between_extremes(std::string& bytes,
                                                   std::span<const double> value, int steps) {
  float low = 0, high = 0;
  bool first = true;
  for (const double v : value) {
    if (!std::isfinite(v)) continue;
    const auto f = static_cast<float>(v);
    low = first ? f : std::min(low, f);
    high = first ? f : std::max(high, f);
    first = false;
  }
  append_float(bytes, low);
  append_float(bytes, high);
  const double span = static_cast<double>(high) - low;
  std::vector<std::uint32_t> level;
  level.reserve(value.size());
  for (const double v : value) {
    const double share = span > 0 ? std::clamp((v - low) / span, 0.0, 1.0) : 0;
    level.push_back(std::isfinite(v) ? static_cast<std::uint32_t>(std::lround(share * steps))
                                     : static_cast<std::uint32_t>(steps) + 1U);
  }
  return level;
}

std::string encode_base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = (group << 8) | (b < n ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d)
      text += d <= n ? kDigits[(group >> (18 - 6 * d)) & 63] : '=';
  }
  return text;
}

}  // namespace

void append_integers(std::string& bytes, std::span<const std::int64_t> value) {
  std::vector<std::uint32_t> step;
  step.reserve(value.size());
  std::int64_t before = 0;
  for (const std::int64_t v : value) {
    step.push_back(static_cast<std::uint32_t>(v - before));
    before = v;
  }
  append_planes(bytes, step, 4);
}

void append_quantised(std::string& bytes, std::span<const double> value) {
  append_planes(bytes, levels_between_extremes(bytes, value, kQuantisedSteps), 2);
}

void append_levels(std::string& bytes, std::span<const double> value) {
  constexpr int kSteps = 254;
  std::uint32_t before = 0;
  for (const std::uint32_t level : levels_between_extremes(bytes, value, kSteps)) {
    bytes += static_cast<char>((level - before) & 0xff);
    before = level;
  }
}

std::string encode_chunk(std::string_view bytes) {
  constexpr int kCompressionLevel = 6;
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  const int code =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), kCompressionLevel);
  check(code == Z_OK, "out of memory while packing the data of a page", Exit::kInternal);
  packed.resize(size);
  return encode_base64(packed);
}

}  // namespace acinus::service
