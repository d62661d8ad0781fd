#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/readers/surface_formats.hpp"

namespace acinus::geometry {
namespace {

enum class PlyType { kI8, kU8, kI16, kU16, kI32, kU32, kF32, kF64 };

std::optional<PlyType> type_by_name(std::string_view name) {
  constexpr std::array<std::pair<const char*, PlyType>, 16> kNames{{
      {"char", PlyType::kI8},
      {"int8", PlyType::kI8},
      {"uchar", PlyType::kU8},
      {"uint8", PlyType::kU8},
      {"short", PlyType::kI16},
      {"int16", PlyType::kI16},
      {"ushort", PlyType::kU16},
      {"uint16", PlyType::kU16},
      {"int", PlyType::kI32},
      {"int32", PlyType::kI32},
      {"uint", PlyType::kU32},
      {"uint32", PlyType::kU32},
      {"float", PlyType::kF32},
      {"float32", PlyType::kF32},
      {"double", PlyType::kF64},
      {"float64", PlyType::kF64},
  }};
  for (const auto& [text, type] : kNames)
    if (name == text) return type;
  return std::nullopt;
}

struct Property {
  std::string name;
  PlyType type = PlyType::kF32;
  std::optional<PlyType> count;  ///< type of a list's count
};

struct Element {
  std::string name;
  std::int64_t n = 0;
  std::vector<Property> property;
};

enum class Encoding { kText, kLittle, kBig };

/// Sequential reader of the numbers of the body.
class PlyValues {
 public:
  PlyValues(InputFile& file, Encoding encoding) : file_(file), encoding_(encoding) {}

  double next(PlyType type, std::string_view what) {
    if (encoding_ == Encoding::kText) return file_.next_double(what);
    switch (type) {
      case PlyType::kI8:
        return next_binary<std::int8_t>(what);
      case PlyType::kU8:
        return next_binary<std::uint8_t>(what);
      case PlyType::kI16:
        return next_binary<std::int16_t>(what);
      case PlyType::kU16:
        return next_binary<std::uint16_t>(what);
      case PlyType::kI32:
        return next_binary<std::int32_t>(what);
      case PlyType::kU32:
        return next_binary<std::uint32_t>(what);
      case PlyType::kF32:
        return static_cast<double>(next_binary<float>(what));
      case PlyType::kF64:
        break;
    }
    return next_binary<double>(what);
  }

 private:
  template <class T>
  T next_binary(std::string_view what) {
    if (file_.remaining() < sizeof(T))
      file_.fail_at(file_.position(),
                    fmt::format("the file ends where {} is expected. It is truncated.", what));
    std::array<char, sizeof(T)> bytes;
    std::copy_n(file_.bytes().data() + file_.position(), sizeof(T), bytes.begin());
    if (encoding_ == Encoding::kBig) std::ranges::reverse(bytes);
    file_.set_position(file_.position() + sizeof(T));
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  InputFile& file_;
  Encoding encoding_;
};

PlyType next_type(InputFile& file) {
  const std::string_view token = file.next_token();
  const auto type = type_by_name(token);
  if (!type) file.fail(fmt::format("{} is no type of a PLY property.", in_quotes(token)));
  return *type;
}

/// Reads the header; leaves the cursor behind it.
std::pair<Encoding, std::vector<Element>> read_header(InputFile& file) {
  if (lower_case(file.next_token()) != "ply")
    file.fail("the file does not begin with \"ply\". Is it a PLY file?");
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
  for (;;) {
    const std::string_view word = file.next_token();
    if (word == "end_header") break;
    if (word == "format") {
      const std::string_view name = file.next_token();
      if (name == "binary_little_endian")
        encoding = Encoding::kLittle;
      else if (name == "binary_big_endian")
        encoding = Encoding::kBig;
      else if (name != "ascii")
        file.fail(fmt::format("the format {} is not read.", in_quotes(name)));
      file.next_line();
    } else if (word == "comment" || word == "obj_info") {
      file.next_line();
    } else if (word == "element") {
      Element e;
      e.name = file.next_token();
      e.n = file.next_integer("a number of elements");
      if (e.n < 0) file.fail("a number of elements must be 0 or more.");
      elements.push_back(std::move(e));
    } else if (word == "property" && !elements.empty()) {
      Property p;
      if (file.peek_token() == "list") {
        file.next_token();
        p.count = next_type(file);
      }
      p.type = next_type(file);
      p.name = file.next_token();
      elements.back().property.push_back(std::move(p));
    } else {
      file.fail(word.empty() ? std::string("the header ends early. The file looks truncated.")
                             : fmt::format("{} is not expected in the header of a PLY file.",
                                           in_quotes(word)));
    }
  }
  file.next_line();
  return {encoding, std::move(elements)};
}

/// Number of values of a property: one, or the count that precedes a list.
std::int64_t length_of(InputFile& file, const Property& p, PlyValues& values) {
  if (!p.count) return 1;
  const std::size_t place = file.position();
  const double n = values.next(*p.count, "a length of a list");
  if (!(n >= 0 && n <= static_cast<double>(file.remaining()) && n == std::floor(n)))
    file.fail_at(place, fmt::format("a list of {} says {} values; {} bytes follow. The file is "
                                    "truncated or damaged.",
                                    in_quotes(p.name), n, file.remaining()));
  return static_cast<std::int64_t>(n);
}

void read_vertex(InputFile& file, const Element& e, PlyValues& values, std::int64_t number,
                 Surface& out) {
  Vec3 x = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const std::size_t place = file.position();
  for (const Property& p : e.property) {
    const std::int64_t n = length_of(file, p, values);
    for (std::int64_t k = 0; k < n; ++k) {
      const double value = values.next(p.type, p.name);
      if (p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') x[p.name[0] - 'x'] = value;
    }
  }
  if (!is_coordinate(x))
    file.fail_at(place, fmt::format("vertex {} is at ({}, {}, {}); it needs x, y and z, and {}.",
                                    number, x[0], x[1], x[2], kCoordinateRule));
  out.node.push_back(x);
}

void read_face(InputFile& file, const Element& e, PlyValues& values, std::int64_t number,
               Surface& out) {
  std::vector<int> corner;
  const std::size_t place = file.position();
  for (const Property& p : e.property) {
    const std::int64_t n = length_of(file, p, values);
    const bool is_face = p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
    for (std::int64_t k = 0; k < n; ++k) {
      const double value = values.next(p.type, "a corner of a face");
      if (!is_face) continue;
      if (!(value >= 0 && value < static_cast<double>(out.node.size())))
        file.fail_at(
            place, fmt::format("face {} uses vertex {}, but there are {}, numbered from 0.", number,
                               value, out.node.size()));
      corner.push_back(static_cast<int>(value));
    }
  }
  const std::string fault = add_polygon(corner, out);
  if (!fault.empty()) file.fail_at(place, fmt::format("face {}{}", number, fault));
}

}  // namespace

Soup read_ply(const std::string& path) {
  InputFile file(path);
  file.skip_byte_order_mark();
  const auto [encoding, elements] = read_header(file);
  if (encoding != Encoding::kText) file.set_binary(true);
  PlyValues values(file, encoding);
  Soup soup;
  for (const Element& e : elements) {
    if (e.n > 0 && e.property.empty())
      file.fail(fmt::format("{} elements {} without properties are announced. The file is damaged.",
                            e.n, in_quotes(e.name)));
    file.check_room(static_cast<std::uint64_t>(e.n), e.property.size(), e.name);
    for (std::int64_t k = 0; k < e.n; ++k) {
      if (e.name == "vertex") {
        read_vertex(file, e, values, k, soup.surface);
      } else if (e.name == "face") {
        read_face(file, e, values, k, soup.surface);
      } else {
        for (const Property& p : e.property) {
          const std::int64_t n = length_of(file, p, values);
          for (std::int64_t i = 0; i < n; ++i) values.next(p.type, p.name);
        }
      }
    }
  }
  if (!file.peek_token().empty())
    file.fail_at(file.position(),
                 fmt::format("the file goes on behind all the elements that its header announces. "
                             "A count is wrong or the file is damaged."));
  return soup;
}

}  // namespace acinus::geometry
