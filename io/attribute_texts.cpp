#include "io/attribute_texts.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "core/error.hpp"

namespace acinus::io {
namespace {

constexpr std::size_t kMostTexts = 32, kMostBytes = 1 << 16;

/// Little-endian number of `bytes` bytes.
std::uint64_t number(const char* raw, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t k = bytes; k-- > 0;) value = value << 8 | static_cast<unsigned char>(raw[k]);
  return value;
}

/// Position of a text of variable length: an object in a global heap of the file.
struct HeapReference {
  std::uint64_t length = 0, heap = 0, object = 0;
};
constexpr std::size_t kReferenceBytes = 16;

/// Reads the stored references of an attribute by a conversion that changes nothing.
std::vector<HeapReference> read_references(hid_t attribute, std::size_t n) {
  const h5::Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(text.id(), H5T_VARIABLE);
  const h5::Handle raw(H5Tcreate(H5T_OPAQUE, kReferenceBytes), H5Tclose);
  std::vector<char> bytes(kReferenceBytes * n);
  constexpr const char* kName = "stored reference";
  const H5T_conv_t keep_as_stored = [](hid_t, hid_t, H5T_cdata_t* data, auto...) -> herr_t {
    data->need_bkg = H5T_BKG_NO;
    return 0;
  };
  H5Tregister(H5T_PERS_SOFT, kName, text.id(), raw.id(), keep_as_stored);
  const herr_t status = H5Aread(attribute, raw.id(), bytes.data());
  H5Tunregister(H5T_PERS_SOFT, kName, text.id(), raw.id(), keep_as_stored);
  std::vector<HeapReference> out;
  for (std::size_t k = 0; status >= 0 && k < n; ++k) {
    const char* at = &bytes[kReferenceBytes * k];
    out.push_back({number(at, 4), number(at + 4, 8), number(at + 12, 4)});
  }
  return out;
}

/// Reads a text from its heap, in which objects follow each other, each with its number and size
/// [HDF5 File Format, III.E]. @return false if the object is not there
bool find_in_heap(std::ifstream& file, const HeapReference& place, std::string& out) {
  constexpr std::size_t kHead = 16, kMostObjects = 1 << 16;
  std::array<char, kHead> head{};
  const auto read = [&](std::uint64_t at, std::size_t n, char* to) {
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    file.read(to, static_cast<std::streamsize>(n));
    return file.gcount() == static_cast<std::streamsize>(n);
  };
  if (!read(place.heap, kHead, head.data()) || std::memcmp(head.data(), "GCOL", 4) != 0)
    return false;
  const std::uint64_t size = number(&head[8], 8);
  std::uint64_t at = kHead;
  for (std::size_t k = 0; k < kMostObjects && at + kHead <= size; ++k) {
    if (!read(place.heap + at, kHead, head.data())) return false;
    const std::uint64_t index = number(head.data(), 2), bytes = number(&head[8], 8);
    if (index == 0 || bytes > size - at) return false;
    if (index == place.object) {
      if (place.length > bytes || bytes > kMostBytes) return false;
      out.resize(place.length);
      return read(place.heap + at + kHead, place.length, out.data());
    }
    at += kHead + (bytes + 7) / 8 * 8;
  }
  return false;
}

}  // namespace

std::vector<std::string> read_attribute_texts(const std::string& path, const h5::Handle& object,
                                              const char* name) {
  if (H5Aexists(object.id(), name) <= 0) return {};
  const auto damaged = [&] {
    return Error(
        fmt::format("{}: cannot read the attribute {}. The file is damaged, or the text is "
                    "too long.",
                    path, name),
        Exit::kFileError);
  };
  const h5::Handle attribute(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) throw damaged();
  const h5::Handle space(H5Aget_space(attribute.id()), H5Sclose);
  const h5::Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space.id());
  if (H5Tget_class(type.id()) != H5T_STRING) return {};
  if (n < 1 || n > static_cast<hssize_t>(kMostTexts)) throw damaged();
  std::vector<std::string> out(n);
  if (H5Tis_variable_str(type.id()) > 0) {
    const std::vector<HeapReference> place = read_references(attribute.id(), out.size());
    std::ifstream file(path, std::ios::binary);
    if (place.size() != out.size()) throw damaged();
    for (std::size_t k = 0; k < out.size(); ++k)
      if (place[k].length > 0 && !find_in_heap(file, place[k], out[k])) throw damaged();
  } else {
    const std::size_t width = H5Tget_size(type.id());
    std::vector<char> text(width == 0 || width > kMostBytes ? 0 : width * out.size());
    if (text.empty() || H5Aread(attribute.id(), type.id(), text.data()) < 0) throw damaged();
    for (std::size_t k = 0; k < out.size(); ++k) out[k].assign(&text[k * width], width);
  }
  for (std::string& t : out) t.resize(strnlen(t.data(), t.size()));
  return out;
}

}  // namespace acinus::io
