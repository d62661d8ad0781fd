#pragma once
/// Numbers as the page's script reads them (page/data.js): little-endian, in byte planes, deflated,
/// base64.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace acinus::runs {

/// Values of quantised numbers: 0 to this; the next one stands for a number that does not exist.
inline constexpr int kQuantisedSteps = 65534;

/// Appends differences of neighbours, 32 bits, as four planes of bytes: ids and corners of
/// triangles of many cells alike then repeat themselves and take next to nothing.
void append_integers(std::string& bytes, std::span<const std::int64_t> value);

/// Appends the smallest and the largest value (float), then 16 bits each, high bytes first. Off by
/// at most half of (largest - smallest) / kQuantisedSteps, and the float rounding of the two.
void append_quantised(std::string& bytes, std::span<const double> value);

/// zlib (RFC 1950), base64.
std::string encode_chunk(std::string_view bytes);

}  // namespace acinus::runs
