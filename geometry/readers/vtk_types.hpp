#pragma once
/// Number types and names of legacy VTK files.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace acinus::geometry {

struct VtkType {
  const char* name;
  std::size_t bytes;  ///< of one value in a binary file
  enum Kind { kSigned, kUnsigned, kReal } kind;
};

/// Type called `token`, upper or lower case; nullptr when it is not supported.
const VtkType* find_vtk_type(std::string_view token);

/// Value stored big-endian.
template <class Value>
Value decode_vtk(const char* bytes, const VtkType& type) {
  std::uint64_t raw = 0;
  for (std::size_t b = 0; b < type.bytes; ++b) {
    raw = raw << 8 | static_cast<unsigned char>(bytes[b]);
  }
  if (type.kind == VtkType::kReal && type.bytes == 4) {
    return static_cast<Value>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  }
  if (type.kind == VtkType::kReal) return static_cast<Value>(std::bit_cast<double>(raw));
  if (type.kind == VtkType::kUnsigned) return static_cast<Value>(raw);
  const int shift = 64 - 8 * static_cast<int>(type.bytes);
  return static_cast<Value>(static_cast<std::int64_t>(raw << shift) >> shift);
}

/// Array name with its %20-like codes decoded.
std::string decode_vtk_name(std::string_view token);

}  // namespace acinus::geometry
