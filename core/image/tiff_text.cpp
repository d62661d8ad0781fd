#include "core/image/tiff_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "core/error.hpp"
#include "core/image/image_formats.hpp"
#include "core/mesh/input_file.hpp"

namespace acinus::image {
namespace {

/// The value of an attribute within one tag of XML.
std::optional<std::string> find_attribute(std::string_view tag, std::string_view name) {
  std::size_t at = 0;
  while ((at = tag.find(name, at)) != tag.npos) {
    const std::size_t end = at + name.size();
    const bool begins = at > 0 && std::isspace(static_cast<unsigned char>(tag[at - 1])) != 0;
    if (begins && end + 1 < tag.size() && tag[end] == '=' &&
        (tag[end + 1] == '"' || tag[end + 1] == '\'')) {
      const std::size_t close = tag.find(tag[end + 1], end + 2);
      if (close != tag.npos) return std::string(tag.substr(end + 2, close - end - 2));
    }
    at = end;
  }
  return std::nullopt;
}

double number_of(const std::string& path, const std::string& name, const std::string& text) {
  double value = 0;
  check(mesh::parse_double(text, value) && value > 0,
        fmt::format("{}: OME says {} = {}; a number above 0 is needed. Give --voxel, or write the "
                    "image again.",
                    path, name, mesh::in_quotes(text)));
  return value;
}

/// "&#181;m" and "&#xB5;m" are micrometres as well.
std::string plain_unit(std::string text) {
  for (const char* micro : {"&#181;", "&#xB5;", "&#xb5;", "&#956;", "&micro;"})
    if (text.starts_with(micro)) return text.replace(0, std::string_view(micro).size(), "u");
  return text;
}

void read_ome(const std::string& path, std::string_view text, TiffText& out) {
  const std::size_t begin = text.find("<Pixels");
  check(begin != text.npos,
        fmt::format("{}: its OME description has no Pixels. Write the image again.", path));
  const std::string_view tag = text.substr(begin, text.find('>', begin) - begin);
  const std::array<std::pair<const char*, std::int64_t*>, 3> sizes{
      {{"SizeZ", &out.slices}, {"SizeC", &out.channels}, {"SizeT", &out.times}}};
  for (const auto& [name, value] : sizes)
    if (const auto t = find_attribute(tag, name))
      *value = static_cast<std::int64_t>(number_of(path, name, *t));
  if (const auto order = find_attribute(tag, "DimensionOrder"); order && order->size() == 5)
    out.order = order->substr(2);
  const std::array<const char*, 3> axis{"PhysicalSizeX", "PhysicalSizeY", "PhysicalSizeZ"};
  for (int k = 0; k < 3; ++k) {
    const std::string name = axis[static_cast<std::size_t>(k)];
    const auto size = find_attribute(tag, name);
    if (!size) continue;
    const std::string unit = plain_unit(find_attribute(tag, name + "Unit").value_or("um"));
    const double um = unit_by_name(unit);
    check(um > 0, fmt::format("{}: OME says {}Unit = {}, which is not known. Give --voxel.", path,
                              name, mesh::in_quotes(unit)));
    out.step[k] = um * number_of(path, name, *size);
  }
}

/// "key=value" on a line of its own.
std::optional<std::string> find_line(const std::string& text, const std::string& key) {
  const std::size_t at = ("\n" + text).find("\n" + key + "=");
  if (at == std::string::npos) return std::nullopt;
  const std::size_t first = at + key.size() + 1;
  const std::size_t end = std::min(text.find_first_of("\r\n", first), text.size());
  return text.substr(first, end - first);
}

void read_imagej(const std::string& text, TiffText& out) {
  const std::array<std::pair<const char*, std::int64_t*>, 4> sizes{{{"slices", &out.slices},
                                                                    {"channels", &out.channels},
                                                                    {"frames", &out.times},
                                                                    {"images", &out.images}}};
  for (const auto& [key, value] : sizes)
    if (const auto t = find_line(text, key)) {
      std::int64_t n = 0;
      if (mesh::parse_integer(*t, n) && n > 0) *value = n;
    }
  const double unit = unit_by_name(find_line(text, "unit").value_or(""));
  if (!(unit > 0)) return;
  out.pixel_unit = unit;
  double spacing = 0;
  if (mesh::parse_double(find_line(text, "spacing").value_or(""), spacing) && spacing > 0)
    out.step[2] = unit * spacing;
}

}  // namespace

std::int64_t TiffText::page(std::int64_t slice, std::int64_t channel) const {
  std::int64_t page = 0, stride = 1;
  for (const char axis : order) {
    const std::int64_t index = axis == 'Z'   ? slice
                               : axis == 'C' ? channel % channels
                                             : channel / channels;
    page += stride * index;
    stride *= axis == 'Z' ? slices : axis == 'C' ? channels : times;
  }
  return page;
}

TiffText read_tiff_text(const std::string& path, const std::string& description) {
  TiffText out;
  if (description.find("<OME") != std::string::npos) {
    out.is_ome = true;
    read_ome(path, description, out);
  } else if (description.starts_with("ImageJ")) {
    out.is_imagej = true;
    read_imagej(description, out);
  }
  return out;
}

}  // namespace acinus::image
