/// MetaImage: a text header of "Key = Value", the data behind it or in a file of their own.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/image/header_fields.hpp"
#include "core/image/image_formats.hpp"
#include "core/mesh/input_file.hpp"

namespace acinus::image {
namespace {

constexpr std::array<std::pair<const char*, Scalar>, 12> kTypes{{
    {"met_uchar", Scalar::kU8},
    {"met_char", Scalar::kI8},
    {"met_ushort", Scalar::kU16},
    {"met_short", Scalar::kI16},
    {"met_uint", Scalar::kU32},
    {"met_int", Scalar::kI32},
    {"met_ulong_long", Scalar::kU64},
    {"met_long_long", Scalar::kI64},
    {"met_ulong", Scalar::kU64},
    {"met_long", Scalar::kI64},
    {"met_float", Scalar::kF32},
    {"met_double", Scalar::kF64},
}};

constexpr const char* kData = "elementdatafile";

/// Leaves the cursor behind the line that says where the data are.
HeaderFields read_header(mesh::InputFile& file) {
  HeaderFields fields(file, "Write the image again, for instance with ITK or Fiji.");
  while (file.remaining() > 0 && !fields.has(kData)) {
    const std::size_t place = file.position();
    const std::string_view line = file.next_line();
    const std::size_t equals = line.find('=');
    if (equals != line.npos)
      fields.add(line.substr(0, equals), line.substr(equals + 1), place);
    else if (!trimmed(line).empty())
      file.fail_at(place, "a line of the header without \"=\". Is this a MetaImage?");
  }
  check(fields.has(kData),
        fmt::format("{}: the header has no ElementDataFile: it looks truncated.", file.path()));
  return fields;
}

bool is_true(const HeaderFields& h, const char* name) {
  const std::string t = mesh::lower_case(h.text(name));
  return t == "true" || t == "1";
}

Scalar type_of(const HeaderFields& header) {
  const std::string name = mesh::lower_case(header.text("elementtype"));
  for (const auto& [text, type] : kTypes)
    if (name == text) return type;
  header.fail("elementtype", fmt::format("the element type {} is not read; use MET_UCHAR, "
                                         "MET_USHORT or MET_UINT",
                                         mesh::in_quotes(header.text("elementtype"))));
}

void check_supported(const HeaderFields& h) {
  if (h.numbers("ndims") != std::vector<double>{3})
    h.fail("ndims", fmt::format("the image has {} dimensions; three are needed",
                                mesh::in_quotes(h.text("ndims"))));
  if (h.has("elementnumberofchannels") && h.numbers("elementnumberofchannels") != std::vector{1.0})
    h.fail("elementnumberofchannels", "several channels a voxel are not read");
}

}  // namespace

ImageFile read_metaimage(const std::string& path) {
  mesh::InputFile file(path);
  const HeaderFields h = read_header(file);
  check_supported(h);
  ImageFile out;
  out.type = type_of(h);
  const std::vector<double> size = h.numbers("dimsize");
  const std::string spacing = h.has("elementspacing") ? "elementspacing" : "elementsize";
  const std::vector<double> step = h.numbers(spacing);
  if (size.size() != 3) h.fail("dimsize", "DimSize needs three numbers");
  if (!step.empty() && step.size() != 3) h.fail(spacing, "the spacing needs three numbers");
  for (std::size_t k = 0; k < 3; ++k) {
    constexpr double kMost = 1e15;
    if (!(size[k] >= 1 && size[k] <= kMost)) h.fail("dimsize", "DimSize must be 1 or more");
    out.size[k] = static_cast<std::int64_t>(size[k]);
    if (!step.empty()) out.step[static_cast<int>(k)] = step[k];
  }
  out.unit = unit_by_name(h.text("distanceunits"));

  ImageBytes data;
  data.path = path;
  data.compressed = is_true(h, "compresseddata");
  data.swap = is_true(h, "binarydatabyteordermsb") || is_true(h, "elementbyteordermsb");
  const std::string name = h.text(kData);
  if (mesh::lower_case(name) == "local") {
    data.stored = file.bytes().substr(file.position());
    take_bytes(data, out);
    return out;
  }
  if (mesh::lower_case(name) == "list" || name.find('%') != name.npos)
    h.fail(kData, "data in a list of files are not read: write one file");
  data.path = (std::filesystem::path(path).parent_path() / name).string();
  const mesh::InputFile raw(data.path);
  data.stored = raw.bytes();
  const std::vector<double> skip = h.numbers("headersize");
  if (!skip.empty() && !data.compressed) {  // -1: the data are at the end
    const std::size_t length = count_voxels(path, out.size) * bytes_of(out.type);
    const double from = skip[0] < 0
                            ? static_cast<double>(raw.bytes().size()) - static_cast<double>(length)
                            : skip[0];
    if (!(from >= 0 && from <= static_cast<double>(raw.bytes().size())))
      h.fail("headersize", fmt::format("{} has {} bytes only", data.path, raw.bytes().size()));
    data.stored.remove_prefix(static_cast<std::size_t>(from));
    data.stored = data.stored.substr(0, length);
  }
  take_bytes(data, out);
  return out;
}

}  // namespace acinus::image
