#pragma once
/// Numbers packed for the page's script (page/src/data.js): little-endian byte planes, deflated,
/// base64.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace acinus::service {

/// Largest quantised value, with 0 the smallest; the next one stands for NaN.
inline constexpr int kQuantisedSteps = 65534;

/// Appends differences of consecutive integers, 32 bits each, as four byte planes. Ids and corners
/// of many equal meshes then compress to almost nothing.
void append_integers(std::string& bytes, std::span<const std::int64_t> value);

/// Appends minimum and maximum (float), then 16-bit values, high bytes first. Error: at most half
/// of (maximum - minimum) / kQuantisedSteps, plus float rounding of the two.
void append_quantised(std::string& bytes, std::span<const double> value);

/// Appends minimum and maximum (float), then differences of consecutive levels between them, a byte
/// each, modulo 256. Level 255 stands for NaN. Error: at most half of (maximum - minimum) / 254.
void append_levels(std::string& bytes, std::span<const double> value);

/// Compresses with zlib (RFC 1950) and encodes as base64.
std::string encode_chunk(std::string_view bytes);

}  // namespace acinus::service
