/// Reader of MetaImage: a text header of "Key = Value", the data behind it or in a separate file.

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/header_fields.hpp"
#include "imaging/image_formats.hpp"

namespace acinus::imaging {
namespace {

constexpr std::array<std::pair<const char*, Scalar>, 12> kMetaTypes{{
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

/// Reads the header; leaves the cursor behind the line that names the place of the data.
HeaderFields read_meta_header(geometry::InputFile& file) {
  HeaderFields fields(file, "Write the image again, for instance with ITK or Fiji.");
  while (file.remaining() > 0 && !fields.has(kData)) {
    const std::size_t place = file.position();
    const std::string_view line = file.next_line();
    const std::size_t equals = line.find('=');
    if (equals != line.npos)
      fields.add(line.substr(0, equals), line.substr(equals + 1), place);
    else if (!geometry::trimmed(line).empty())
      file.fail_at(place, "a line of the header without \"=\". Is this a MetaImage?");
  }
  check(fields.has(kData),
        fmt::format("{}: the header has no ElementDataFile: it looks truncated.", file.path()));
  return fields;
}

bool is_true(const HeaderFields& h, const char* name) {
  const std::string t = geometry::lower_case(h.text(name));
  return t == "true" || t == "1";
}

Scalar meta_type_of(const HeaderFields& header) {
  const std::string name = geometry::lower_case(header.text("elementtype"));
  for (const auto& [text, type] : kMetaTypes)
    if (name == text) return type;
  header.fail("elementtype", fmt::format("the element type {} is not read; use MET_UCHAR, "
                                         "MET_USHORT or MET_UINT",
                                         geometry::in_quotes(header.text("elementtype"))));
}

/// Reads the sides of a voxel, which two fields may state.
void take_meta_steps(const HeaderFields& h, ImageFile& out) {
  std::array<std::vector<double>, 2> said{h.numbers("elementspacing"), h.numbers("elementsize")};
  for (std::size_t k = 0; k < 2; ++k)
    if (!said[k].empty() && said[k].size() != 3)
      h.fail(k == 0 ? "elementspacing" : "elementsize", "three numbers are needed");
  if (!said[0].empty() && !said[1].empty() && said[0] != said[1])
    out.step_fault = fmt::format("ElementSpacing says {}, ElementSize {}", h.text("elementspacing"),
                                 h.text("elementsize"));
  const std::vector<double>& step = said[0].empty() ? said[1] : said[0];
  if (!step.empty()) out.step = Vec3(step[0], step[1], step[2]);
  const std::string unit = h.text("distanceunits");
  out.unit = Vec3::Constant(unit_by_name(unit));
  if (!unit.empty() && unit != "?" && out.unit[0] == 0)
    out.note.push_back("DistanceUnits = " + geometry::in_quotes(unit) +
                       " is no unit that is known");
  for (const char* name : {"transformmatrix", "orientation", "rotation"}) {
    const std::vector<double> m = h.numbers(name);
    if (m.size() == 9) note_axes(Eigen::Map<const Eigen::Matrix3d>(m.data()), name, out);
  }
}

/// First byte of the voxels in a data file, after HeaderSize.
std::uint64_t find_start(const HeaderFields& h, const ImageBytes& data, ImageFile& out) {
  const double skip = h.number("headersize").value_or(0);
  if (skip == 0) return 0;
  const auto size = static_cast<double>(std::filesystem::file_size(data.path));
  const auto length =
      static_cast<double>(out.rows.n_voxel()) * static_cast<double>(bytes_of(out.type));
  if (skip < 0 && data.compressed)
    h.fail("headersize", "HeaderSize = -1 (data at the end) needs data without compression");
  const double from = skip < 0 ? size - length : skip;
  if (!(from >= 0 && from <= size))
    h.fail("headersize", fmt::format("{} has {:.0f} bytes only", data.path, size));
  if (skip < 0 && from > 0)
    out.note.push_back(fmt::format("HeaderSize = -1: the first {:.0f} bytes of {} are passed over",
                                   from, data.path));
  return static_cast<std::uint64_t>(from);
}

/// Throws Error if CompressedDataSize is stated and differs from the size of the data.
void check_stored(const HeaderFields& h, const ImageBytes& data) {
  const std::optional<double> size = h.number("compresseddatasize");
  const std::uint64_t stored = std::filesystem::file_size(data.path) - data.from;
  if (!size || !data.compressed || *size == static_cast<double>(stored)) return;
  h.fail("compresseddatasize",
         fmt::format("CompressedDataSize says {} bytes, but there are {}: the file is truncated or "
                     "damaged",
                     *size, stored));
}

void check_supported(const HeaderFields& h) {
  if (h.numbers("ndims") != std::vector<double>{3})
    h.fail("ndims", fmt::format("the image has {} dimensions; three are needed",
                                geometry::in_quotes(h.text("ndims"))));
  if (h.has("elementnumberofchannels") && h.numbers("elementnumberofchannels") != std::vector{1.0})
    h.fail("elementnumberofchannels", "several channels a voxel are not read");
  if (h.has("binarydata") && !is_true(h, "binarydata"))
    h.fail("binarydata", "numbers written as text (BinaryData = False) are not read");
  if (h.number("elementtointensityfunctionslope").value_or(1) != 1 ||
      h.number("elementtointensityfunctionoffset").value_or(0) != 0)
    h.fail("elementtointensityfunctionslope",
           "its numbers are to be scaled (ElementToIntensityFunction), labels must be as they are");
  if (h.has("binarydatabyteordermsb") && h.has("elementbyteordermsb") &&
      is_true(h, "binarydatabyteordermsb") != is_true(h, "elementbyteordermsb"))
    h.fail("elementbyteordermsb", "BinaryDataByteOrderMSB and ElementByteOrderMSB disagree");
}

}  // namespace

ImageFile read_metaimage(const std::string& path) {
  geometry::InputFile file(path, kMostHeader);
  file.skip_byte_order_mark();
  const HeaderFields h = read_meta_header(file);
  check_supported(h);
  ImageFile out;
  out.type = meta_type_of(h);
  out.size = h.sizes("dimsize");
  take_meta_steps(h, out);
  prepare_rows(path, out);

  ImageBytes data;
  data.path = path;
  data.compressed = is_true(h, "compresseddata");
  data.swap = is_true(h, "binarydatabyteordermsb") || is_true(h, "elementbyteordermsb");
  const std::string name = h.text(kData);
  if (geometry::lower_case(name) == "local") {
    data.from = file.position();
    if (h.number("headersize").value_or(0) > 0)
      h.fail("headersize", "HeaderSize is for data in a file of their own, not for LOCAL");
    check_stored(h, data);
    take_bytes(data, out);
    return out;
  }
  if (geometry::lower_case(name) == "list" || name.find('%') != name.npos)
    h.fail(kData, "data in a list of files are not read: write one file");
  data.path = (std::filesystem::path(path).parent_path() / name).string();
  const geometry::InputFile raw(data.path, 1);  // is there
  data.from = find_start(h, data, out);
  check_stored(h, data);
  take_bytes(data, out);
  return out;
}

}  // namespace acinus::imaging
