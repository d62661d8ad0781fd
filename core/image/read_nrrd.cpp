/// NRRD: a text header of "field: value", an empty line, the data behind it or in another file.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/image/header_fields.hpp"
#include "core/image/image_formats.hpp"
#include "core/mesh/input_file.hpp"

namespace acinus::image {
namespace {

constexpr std::array<std::pair<const char*, Scalar>, 27> kTypes{{
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

/// Leaves the cursor behind the empty line.
HeaderFields read_header(mesh::InputFile& file) {
  HeaderFields fields(file, "Write the image again, for instance with 3D Slicer or Fiji.");
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

Scalar type_of(const HeaderFields& h) {
  const std::string name = mesh::lower_case(h.text("type"));
  for (const auto& [text, type] : kTypes)
    if (name == text) return type;
  h.fail("type", fmt::format("the type {} is not read; use uint8, uint16 or uint32",
                             mesh::in_quotes(h.text("type"))));
}

/// Sides of a voxel: "spacings", or the lengths of "space directions".
Vec3 step_of(const HeaderFields& h) {
  Vec3 step = Vec3::Zero();
  if (const std::vector<double> d = h.numbers("space directions"); !d.empty()) {
    if (d.size() != 9) h.fail("space directions", "three vectors of three numbers are needed");
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(3 * k);
      step[k] = Vec3(d[at], d[at + 1], d[at + 2]).norm();
    }
  } else if (const std::vector<double> s = h.numbers("spacings"); !s.empty()) {
    if (s.size() != 3) h.fail("spacings", "three numbers are needed");
    step = Vec3(s[0], s[1], s[2]);
  }
  for (int k = 0; k < 3; ++k)
    if (std::isnan(step[k])) step[k] = 0;  // not known
  return step;
}

/// The first text in quotes of "units" or "space units".
double unit_of(const HeaderFields& h) {
  for (const char* name : {"space units", "units"}) {
    const std::string t = h.text(name);
    const std::size_t first = t.find('"');
    const std::size_t last = first == t.npos ? t.npos : t.find('"', first + 1);
    if (last != t.npos) return unit_by_name(t.substr(first + 1, last - first - 1));
  }
  return 0;
}

/// Labels written as text.
std::string take_text(std::string_view text, mesh::InputFile& file, std::size_t n) {
  file.set_position(static_cast<std::size_t>(text.data() - file.bytes().data()));
  std::string out;
  for (std::size_t k = 0; k < n; ++k) {
    const double value = file.next_double("a label");
    out.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  return out;
}

}  // namespace

ImageFile read_nrrd(const std::string& path) {
  mesh::InputFile file(path);
  const HeaderFields h = read_header(file);
  ImageFile out;
  if (h.numbers("dimension") != std::vector<double>{3})
    h.fail("dimension", fmt::format("the image has {} dimensions; three are needed",
                                    mesh::in_quotes(h.text("dimension"))));
  out.type = type_of(h);
  const std::vector<double> size = h.numbers("sizes");
  if (size.size() != 3) h.fail("sizes", "three sizes are needed");
  for (std::size_t k = 0; k < 3; ++k) {
    constexpr double kMost = 1e15;
    if (!(size[k] >= 1 && size[k] <= kMost)) h.fail("sizes", "sizes must be 1 or more");
    out.size[k] = static_cast<std::int64_t>(size[k]);
  }
  out.step = step_of(h);
  out.unit = unit_of(h);

  std::string name = h.text("data file");
  if (name.empty()) name = h.text("datafile");
  ImageBytes data{path, file.bytes().substr(file.position()), false, false};
  std::optional<mesh::InputFile> other;
  if (!name.empty()) {
    if (name.starts_with("LIST") || name.find('%') != name.npos)
      h.fail("data file", "data in several files are not read: write one file");
    data.path = (std::filesystem::path(path).parent_path() / name).string();
    data.stored = other.emplace(data.path).bytes();
  }
  for (std::vector<double> n = h.numbers("line skip"); !n.empty() && n[0] > 0; n[0] -= 1) {
    const std::size_t end = data.stored.find('\n');
    if (end == data.stored.npos) h.fail("line skip", "the data have not so many lines");
    data.stored.remove_prefix(end + 1);
  }
  const std::string encoding = mesh::lower_case(h.text("encoding"));
  const std::size_t n_voxel = count_voxels(path, out.size);
  if (encoding == "txt" || encoding == "text" || encoding == "ascii") {
    mesh::InputFile& source = other ? *other : file;
    source.check_room(n_voxel, 2, "the header");
    const std::string values = take_text(data.stored, source, n_voxel);
    data.stored = values;
    const Scalar type = std::exchange(out.type, Scalar::kF64);
    take_bytes(data, out);
    out.type = type;
    return out;
  }
  data.compressed = encoding == "gzip" || encoding == "gz";
  if (!data.compressed && encoding != "raw")
    h.fail("encoding", fmt::format("the encoding {} is not read; use raw, gzip or text",
                                   mesh::in_quotes(h.text("encoding"))));
  if (const std::vector<double> skip = h.numbers("byte skip"); !skip.empty() && !data.compressed) {
    const double length = static_cast<double>(n_voxel * bytes_of(out.type));
    const double from = skip[0] < 0 ? static_cast<double>(data.stored.size()) - length : skip[0];
    if (!(from >= 0 && from <= static_cast<double>(data.stored.size())))
      h.fail("byte skip", "the data are shorter");
    data.stored.remove_prefix(static_cast<std::size_t>(from));
  }
  data.swap = mesh::lower_case(h.text("endian")) == "big";
  take_bytes(data, out);
  return out;
}

}  // namespace acinus::image
