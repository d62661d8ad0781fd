#include "imaging/tiff_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/image_formats.hpp"
#include "imaging/json_statements.hpp"

namespace acinus::imaging {
namespace {

/// Value of "key=value" on a line of its own; nothing if missing. Throws Error at two that differ.
std::optional<std::string> find_line(const std::string& path, const std::string& text,
                                     const std::string& key) {
  std::optional<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.starts_with(key + "=")) continue;
    const std::string value = line.substr(key.size() + 1);
    check(!found || *found == value,
          fmt::format("{}: ImageJ says {}={} and {}={}. Write the image again.", path, key,
                      found.value_or(""), key, value));
    found = value;
  }
  return found;
}

/// Reads the units by axis: "unit" is that of x, and of the others where they have none of their
/// own.
void take_imagej_units(const std::string& path, const std::string& text, TiffText& out) {
  constexpr std::array<const char*, 3> kKeys{"unit", "yunit", "zunit"};
  const std::string first = find_line(path, text, "unit").value_or("");
  for (std::size_t k = 0; k < kKeys.size(); ++k) {
    const std::string unit = find_line(path, text, kKeys[k]).value_or(first);
    out.unit[static_cast<int>(k)] = unit_by_name(unit);
    const bool known = unit.empty() || out.unit[static_cast<int>(k)] > 0;
    if (!known && out.step_fault.empty())
      out.step_fault =
          fmt::format("ImageJ says {}={}, which is no unit that is known", kKeys[k], unit);
  }
}

void read_imagej(const std::string& path, const std::string& text, TiffText& out) {
  const std::array<std::pair<const char*, std::int64_t*>, 4> sizes{{{"slices", &out.slices},
                                                                    {"channels", &out.channels},
                                                                    {"frames", &out.times},
                                                                    {"images", &out.images}}};
  constexpr std::int64_t kMost = 1 << 24;
  for (const auto& [key, value] : sizes)
    if (const auto t = find_line(path, text, key))
      check(geometry::parse_integer(*t, *value) && *value > 0 && *value <= kMost,
            fmt::format("{}: ImageJ says {}={}; a whole number from 1 is needed. Write the image "
                        "again.",
                        path, key, geometry::in_quotes(*t)));
  if (out.images == 0)
    out.images = std::max<std::int64_t>(out.slices, 1) * out.channels * out.times;
  if (out.slices == 0 && out.images % (out.channels * out.times) == 0)
    out.slices = out.images / (out.channels * out.times);
  take_imagej_units(path, text, out);
  double spacing = 0;
  if (geometry::parse_double(find_line(path, text, "spacing").value_or(""), spacing) &&
      std::isfinite(spacing))
    out.step[2] = std::abs(spacing);  // ImageJ takes it so as well
}

/// Pages of tifffile: all axes but the last two, which may have names.
void read_shape(const std::string& path, const TiffShape& shape, TiffText& out) {
  std::string axes = shape.axes;
  std::vector<std::int64_t> length = shape.length;
  if (!axes.empty() && axes.back() == 'S') {  // numbers of a pixel; libtiff counts them as well
    axes.pop_back();
    length.pop_back();
  }
  if (length.size() < 2) return;
  out.width = length.back();
  out.height = length[length.size() - 2];
  out.images = 1;
  out.slices = 1;
  std::string order;
  std::size_t long_axes = 0;
  for (std::size_t k = length.size() - 2; k-- > 0;) {
    out.images *= length[k];
    if (length[k] == 1) continue;
    ++long_axes;
    const char axis = axes.empty() ? 'Z' : axes[k] == 'I' || axes[k] == 'Q' ? 'Z' : axes[k];
    check((axis == 'Z' || axis == 'C' || axis == 'T') && order.find(axis) == order.npos,
          fmt::format("{}: its description says {} pages by the axes {} with {} lengths above 1; "
                      "Z, C and T are read. {}",
                      path, out.images, axes.empty() ? "without names" : geometry::in_quotes(axes),
                      long_axes, "Save one stack, or name the axes (tifffile: axes=\"CZYX\")."));
    order += axis;
    (axis == 'Z' ? out.slices : axis == 'C' ? out.channels : out.times) = length[k];
  }
  for (const char axis : {'C', 'Z', 'T'})
    if (order.find(axis) == order.npos) order += axis;
  out.order = order;
}

}  // namespace

std::int64_t TiffText::plane(std::int64_t slice, std::int64_t channel) const {
  std::int64_t plane = 0, stride = 1;
  for (const char axis : order) {
    const std::int64_t index = axis == 'Z'   ? slice
                               : axis == 'C' ? channel % channels
                                             : channel / channels;
    plane += stride * index;
    stride *= axis == 'Z' ? slices : axis == 'C' ? channels : times;
  }
  return plane;
}

TiffText read_tiff_text(const std::string& path, const std::string& description) {
  if (std::optional<TiffText> ome = read_ome_text(path, description)) return *ome;
  TiffText out;
  if (description.starts_with("ImageJ")) {
    out.is_imagej = true;
    read_imagej(path, description, out);
  } else if (const std::optional<TiffShape> shape = read_tiff_shape(description)) {
    read_shape(path, *shape, out);
  }
  return out;
}

}  // namespace acinus::imaging
