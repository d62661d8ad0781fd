/// Reader of NRRD: a text header of "field: value", an empty line, the data behind it or in another
/// file.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "geometry/readers/input_file.hpp"
#include "imaging/header_fields.hpp"
#include "imaging/image_formats.hpp"

namespace acinus::imaging {
namespace {

constexpr std::array<std::pair<const char*, Scalar>, 27> kNrrdTypes{{
    {"uchar", Scalar::kU8},
    {"unsigned char", Scalar::kU8},
    {"uint8", Scalar::kU8},
    {"uint8_t", Scalar::kU8},
    {"signed char", Scalar::kI8},
    {"int8", Scalar::kI8},
    {"int8_t", Scalar::kI8},
    {"ushort", Scalar::kU16},
    {"unsigned short", Scalar::kU16},
    {"uint16", Scalar::kU16},
    {"uint16_t", Scalar::kU16},
    {"short", Scalar::kI16},
    {"int16", Scalar::kI16},
    {"int16_t", Scalar::kI16},
    {"uint", Scalar::kU32},
    {"unsigned int", Scalar::kU32},
    {"uint32", Scalar::kU32},
    {"uint32_t", Scalar::kU32},
    {"int", Scalar::kI32},
    {"int32", Scalar::kI32},
    {"int32_t", Scalar::kI32},
    {"ulonglong", Scalar::kU64},
    {"uint64", Scalar::kU64},
    {"longlong", Scalar::kI64},
    {"int64", Scalar::kI64},
    {"float", Scalar::kF32},
    {"double", Scalar::kF64},
}};

/// Reads the header; leaves the cursor behind the empty line.
HeaderFields read_nrrd_header(geometry::InputFile& file) {
  HeaderFields fields(file, "Write the image again, for instance with 3D Slicer or Fiji.");
  file.skip_byte_order_mark();
  if (!file.next_line().starts_with("NRRD000"))
    file.fail("the file does not begin with NRRD000. Is this an NRRD file?");
  while (file.remaining() > 0) {
    const std::size_t place = file.position();
    const std::string_view line = file.next_line();
    if (line.empty()) break;
    if (line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == line.npos) file.fail_at(place, "a line of the header without \":\".");
    if (line.substr(colon).starts_with(":=")) continue;  // a key of the user's own
    fields.add(line.substr(0, colon), line.substr(colon + 1), place);
  }
  return fields;
}

Scalar nrrd_type_of(const HeaderFields& h) {
  const std::string name = geometry::lower_case(h.text("type"));
  for (const auto& [text, type] : kNrrdTypes)
    if (name == text) return type;
  h.fail("type", fmt::format("the type {} is not read; use uint8, uint16 or uint32",
                             geometry::in_quotes(h.text("type"))));
}

/// Reads the sides of a voxel: "spacings", or the lengths of "space directions". nan: not stated
/// for that axis.
void take_nrrd_steps(const HeaderFields& h, ImageFile& out) {
  const std::vector<double> d = h.numbers("space directions"), s = h.numbers("spacings");
  if (!d.empty() && d.size() != 9)
    h.fail("space directions", "three vectors of three numbers are needed");
  if (!s.empty() && s.size() != 3) h.fail("spacings", "three numbers are needed");
  Vec3 by_direction = Vec3::Zero(), by_spacing = Vec3::Zero();
  if (!d.empty()) {
    const Eigen::Matrix3d axes = Eigen::Map<const Eigen::Matrix3d>(d.data());
    by_direction = axes.colwise().norm();
    if (axes.allFinite()) note_axes(axes, "space directions", out);
  }
  if (!s.empty()) by_spacing = Vec3(s[0], s[1], s[2]);
  constexpr double kSame = 1e-3;
  for (int k = 0; k < 3; ++k) {
    if (std::isnan(by_direction[k])) by_direction[k] = 0;  // not known
    if (std::isnan(by_spacing[k])) by_spacing[k] = 0;
    out.step[k] = by_direction[k] > 0 ? by_direction[k] : by_spacing[k];
    if (by_direction[k] > 0 && by_spacing[k] > 0 &&
        std::abs(by_direction[k] - by_spacing[k]) > kSame * by_spacing[k])
      out.step_fault = fmt::format("spacings says {:.6g} along axis {}, space directions {:.6g}",
                                   by_spacing[k], k, by_direction[k]);
  }
  for (const char* name : {"axis mins", "axis maxs"})
    if (h.has(name))
      out.note.push_back(fmt::format("{} = {} is not used for the size of voxels", name,
                                     geometry::in_quotes(h.text(name))));
}

/// Quoted texts, one per axis.
std::vector<std::string> quoted(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t at = 0; (at = text.find('"', at)) != text.npos;) {
    const std::size_t last = text.find('"', at + 1);
    if (last == text.npos) break;
    all.push_back(text.substr(at + 1, last - at - 1));
    at = last + 1;
  }
  return all;
}

/// Reads the size of the unit, um, by axis: "units" for spacings, "space units" for directions.
void take_units(const HeaderFields& h, ImageFile& out) {
  for (const char* name : {"units", "space units"}) {
    const std::vector<std::string> unit = quoted(h.text(name));
    if (unit.empty()) continue;
    if (unit.size() != 3) h.fail(name, fmt::format("{} needs three texts in quotes", name));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      const double um = unit_by_name(unit[k]);
      if (um == 0 && !unit[k].empty() && unit[k] != "???")
        out.note.push_back(
            fmt::format("{} says {}, which is not known", name, geometry::in_quotes(unit[k])));
      if (um > 0 && out.unit[axis] > 0 && um != out.unit[axis])
        out.step_fault =
            fmt::format("units says {}, space units {}", h.text("units"), h.text("space units"));
      if (um > 0) out.unit[axis] = um;
    }
  }
}

/// Throws Error at axes that are not spatial (a list, a time).
void check_kinds(const HeaderFields& h) {
  std::string text = geometry::lower_case(h.text("kinds"));
  std::istringstream words(text);
  for (std::string kind; words >> kind;)
    if (kind != "domain" && kind != "space" && kind != "none" && kind != "???")
      h.fail("kinds", fmt::format("an axis has the kind {}; three axes of space are needed: save "
                                  "one channel of one time",
                                  geometry::in_quotes(kind)));
}

/// Reads labels that are written as text.
void take_text(const ImageBytes& data, std::size_t n, ImageFile& out) {
  geometry::InputFile file(data.path);
  file.set_position(data.from);
  file.check_room(n, 2, "the header");
  const Scalar type = std::exchange(out.type, Scalar::kF64);
  std::vector<double> line(out.rows.size[0]);
  for (std::size_t k = 0; k < out.rows.line.size(); ++k) {
    for (double& value : line) value = file.next_double("a label");
    append_lines(data.path, std::as_bytes(std::span(line)), false, k, out);
  }
  out.type = type;
  if (!file.next_token().empty())
    file.fail(
        fmt::format("there are more than the {} labels that the header announces. The file "
                    "is damaged, or its sizes are wrong.",
                    n));
}

/// Path of the data file, if the header is separate.
std::string data_file_of(const HeaderFields& h) {
  const std::string name = h.has("data file") ? h.text("data file") : h.text("datafile");
  if (name.starts_with("LIST") || name.find('%') != name.npos)
    h.fail("data file", "data in several files are not read: write one file");
  return name;
}

void skip_lines(const HeaderFields& h, ImageBytes& data) {
  const double n = h.number("line skip").value_or(0);
  if (!(n > 0)) return;
  std::ifstream in(data.path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(data.from));
  for (double k = 0; k < n; k += 1) {
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!in || in.eof()) h.fail("line skip", "the data have not so many lines");
  }
  data.from = static_cast<std::uint64_t>(in.tellg());
}

/// Skips bytes: before raw data, and at the start of decompressed data.
void skip_bytes(const HeaderFields& h, std::size_t length, ImageBytes& data, ImageFile& out) {
  const double skip = h.number("byte skip").value_or(0);
  constexpr double kMost = 1e15;
  if (skip == 0) return;
  if (!(skip >= -1 && skip <= kMost && skip == std::floor(skip)))
    h.fail("byte skip", fmt::format("byte skip is {}; -1 or a whole number is needed", skip));
  const auto size =
      static_cast<double>(std::filesystem::file_size(data.path)) - static_cast<double>(data.from);
  if (data.compressed) {
    if (skip < 0) h.fail("byte skip", "byte skip: -1 needs data without compression");
    check_announced(data.path, skip, size, true);
    data.skip = static_cast<std::uint64_t>(skip);
    return;
  }
  const double from = skip < 0 ? size - static_cast<double>(length) : skip;
  if (!(from >= 0 && from <= size)) h.fail("byte skip", "byte skip: the data are shorter");
  if (skip < 0 && from > 0)
    out.note.push_back(
        fmt::format("byte skip: -1: the first {:.0f} bytes of the data are passed over", from));
  data.from += static_cast<std::uint64_t>(from);
}

bool is_swapped(const HeaderFields& h, Scalar type) {
  const std::string order = geometry::lower_case(h.text("endian"));
  if (order != "big" && order != "little" && (h.has("endian") || bytes_of(type) > 1))
    h.fail("endian", fmt::format("endian is {}; numbers of more than a byte need little or big",
                                 h.has("endian") ? geometry::in_quotes(order) : "missing"));
  return order == "big";
}

}  // namespace

ImageFile read_nrrd(const std::string& path) {
  geometry::InputFile file(path, kMostHeader);
  const HeaderFields h = read_nrrd_header(file);
  ImageFile out;
  if (h.numbers("dimension") != std::vector<double>{3})
    h.fail("dimension", fmt::format("the image has {} dimensions; three are needed",
                                    geometry::in_quotes(h.text("dimension"))));
  check_kinds(h);
  out.type = nrrd_type_of(h);
  out.size = h.sizes("sizes");
  take_nrrd_steps(h, out);
  take_units(h, out);

  const std::string name = data_file_of(h);
  ImageBytes data;
  data.path = path;
  data.from = file.position();
  if (!name.empty()) {
    data.path = (std::filesystem::path(path).parent_path() / name).string();
    data.from = 0;
    const geometry::InputFile other(data.path, 1);  // is there
  }
  skip_lines(h, data);
  const std::string encoding = geometry::lower_case(h.text("encoding"));
  const std::size_t n_voxel = prepare_rows(path, out);
  if (encoding == "txt" || encoding == "text" || encoding == "ascii") {
    if (h.number("byte skip").value_or(0) != 0)
      h.fail("byte skip", "byte skip is not followed in text");
    take_text(data, n_voxel, out);
    return out;
  }
  data.compressed = encoding == "gzip" || encoding == "gz";
  if (!data.compressed && encoding != "raw")
    h.fail("encoding", fmt::format("the encoding {} is not read; use raw, gzip or text",
                                   geometry::in_quotes(h.text("encoding"))));
  skip_bytes(h, n_voxel * bytes_of(out.type), data, out);
  data.swap = is_swapped(h, out.type);
  take_bytes(data, out);
  return out;
}

}  // namespace acinus::imaging
