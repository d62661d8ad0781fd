#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/image_formats.hpp"
#include "imaging/tiff_text.hpp"

namespace acinus::imaging {
namespace {

/// Name without its prefix: "ome:Pixels" is Pixels.
std::string_view local(const char* name) {
  const std::string_view text = name;
  return text.substr(text.find(':') + 1);
}

std::vector<pugi::xml_node> children(const pugi::xml_node& parent, std::string_view name) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node& child : parent.children())
    if (local(child.name()) == name) found.push_back(child);
  return found;
}

class OmeReader {
 public:
  OmeReader(const std::string& path, TiffText& out) : path_(path), out_(out) {}

  void read(const pugi::xml_node& ome) {
    out_.is_ome = true;
    const std::vector<pugi::xml_node> images = children(ome, "Image");
    if (!children(ome, "BinaryOnly").empty())
      fail(fmt::format("is described in another file ({})",
                       children(ome, "BinaryOnly")[0].attribute("MetadataFile").value()));
    if (images.size() != 1) fail(fmt::format("describes {} images; one is read", images.size()));
    const std::vector<pugi::xml_node> pixels = children(images[0], "Pixels");
    if (pixels.size() != 1) fail(fmt::format("has {} elements Pixels; one is read", pixels.size()));
    pixels_ = pixels[0];
    take_sizes();
    take_steps();
    const std::vector<pugi::xml_node> data = children(pixels_, "TiffData");
    if (!data.empty()) take_planes(data);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}: its OME description {}. Write the image again as one OME-TIFF.",
                            path_, what));
  }

  /// Whole number of an attribute; `otherwise` if it is missing.
  std::int64_t whole(const pugi::xml_node& node, const char* name, std::int64_t least,
                     std::optional<std::int64_t> otherwise) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    constexpr std::int64_t kMost = 1 << 24;
    if (!attribute && otherwise) return *otherwise;
    std::int64_t value = 0;
    if (!geometry::parse_integer(attribute.value(), value) || value < least || value > kMost)
      fail(fmt::format("says {} = {}; a whole number from {} is needed", name,
                       attribute ? geometry::in_quotes(attribute.value()) : "nothing", least));
    return value;
  }

  void take_sizes() {
    out_.slices = whole(pixels_, "SizeZ", 1, {});
    out_.channels = whole(pixels_, "SizeC", 1, {});
    out_.times = whole(pixels_, "SizeT", 1, {});
    out_.width = whole(pixels_, "SizeX", 1, {});
    out_.height = whole(pixels_, "SizeY", 1, {});
    constexpr double kMostPlanes = 1 << 24;
    if (1.0 * out_.slices * static_cast<double>(out_.channels) * static_cast<double>(out_.times) >
        kMostPlanes)
      fail(fmt::format("says {} slices, {} channels and {} times, more than can be", out_.slices,
                       out_.channels, out_.times));
    std::string order = pixels_.attribute("DimensionOrder").value();
    std::string sorted = order;
    std::ranges::sort(sorted);
    if (sorted != "CTXYZ" || !order.starts_with("XY"))
      fail(
          fmt::format("says DimensionOrder = {}; XYZCT or another order that begins with XY is "
                      "needed",
                      geometry::in_quotes(order)));
    out_.order = order.substr(2);
    constexpr std::array<std::pair<const char*, Scalar>, 8> kTypes{{{"uint8", Scalar::kU8},
                                                                    {"int8", Scalar::kI8},
                                                                    {"uint16", Scalar::kU16},
                                                                    {"int16", Scalar::kI16},
                                                                    {"uint32", Scalar::kU32},
                                                                    {"int32", Scalar::kI32},
                                                                    {"float", Scalar::kF32},
                                                                    {"double", Scalar::kF64}}};
    const std::string type = pixels_.attribute("Type").value();
    const auto* found =
        std::ranges::find_if(kTypes, [&](const auto& t) { return type == t.first; });
    if (found == kTypes.end())
      fail(
          fmt::format("says Type = {}; uint8, uint16, uint32, int8, int16, int32, float and double "
                      "are read",
                      geometry::in_quotes(type)));
    out_.type = found->second;
  }

  void take_steps() {
    for (const char axis : {'X', 'Y', 'Z'}) {
      const int k = axis - 'X';
      const std::string name = fmt::format("PhysicalSize{}", axis);
      const pugi::xml_attribute size = pixels_.attribute(name.c_str());
      if (!size) continue;
      const pugi::xml_attribute said = pixels_.attribute((name + "Unit").c_str());
      std::string unit = said ? said.value() : "um";
      if (unit.starts_with("&micro;")) unit.replace(0, 7, "u");  // HTML's name, not XML's
      double value = 0;
      if (!geometry::parse_double(size.value(), value) || !(value > 0))
        out_.step_fault = fmt::format("OME says {} = {}; a number above 0 is needed", name,
                                      geometry::in_quotes(size.value()));
      out_.step[k] = value;
      out_.unit[k] = unit_by_name(unit);
      if (out_.unit[k] == 0)
        out_.step_fault = fmt::format("OME says {}Unit = {}, which is not known", name,
                                      geometry::in_quotes(unit));
    }
    for (const pugi::xml_attribute& a : pixels_.attributes()) {
      const std::string name = a.name();
      constexpr std::array<const char*, 6> kKnown{"PhysicalSizeX",     "PhysicalSizeY",
                                                  "PhysicalSizeZ",     "PhysicalSizeXUnit",
                                                  "PhysicalSizeYUnit", "PhysicalSizeZUnit"};
      if (name.starts_with("Phys") && std::ranges::find(kKnown, name) == kKnown.end())
        out_.step_fault = fmt::format("OME says {}, which is no attribute of sizes", name);
    }
  }

  /// Name of the file that holds the planes; empty where a TiffData names none.
  static std::string file_of(const pugi::xml_node& data) {
    const std::vector<pugi::xml_node> id = children(data, "UUID");
    return id.empty() ? "" : id[0].attribute("FileName").value();
  }

  /// Reads the order of first use, and the pages, of the planes of one TiffData.
  void take_planes(const std::vector<pugi::xml_node>& all) {
    std::set<std::string> files;
    for (const pugi::xml_node& data : all) files.insert(file_of(data));
    const std::string own = std::filesystem::path(path_).filename().string();
    out_.page_of_plane.assign(out_.planes(), TiffText::kNowhere);
    std::set<std::int64_t> pages;
    for (const pugi::xml_node& data : all) {
      const std::string file = file_of(data);
      // A file of its own may have been renamed.
      const bool elsewhere = files.size() > 1 && !file.empty() && file != own;
      const std::int64_t z = whole(data, "FirstZ", 0, 0), c = whole(data, "FirstC", 0, 0),
                         t = whole(data, "FirstT", 0, 0);
      if (z >= out_.slices || c >= out_.channels || t >= out_.times)
        fail(fmt::format("speaks of the plane z {}, c {}, t {} of {} x {} x {}", z, c, t,
                         out_.slices, out_.channels, out_.times));
      const std::int64_t first = out_.plane(z, c + out_.channels * t);
      const bool one = static_cast<bool>(data.attribute("IFD"));
      const std::int64_t ifd = whole(data, "IFD", 0, 0);
      const std::int64_t n = whole(data, "PlaneCount", 0, one ? 1 : out_.planes() - first);
      if (first + n > out_.planes())
        fail(fmt::format("gives {} planes from plane {}, of {} in all", n, first, out_.planes()));
      for (std::int64_t k = 0; k < n; ++k) {
        std::int64_t& page = out_.page_of_plane[first + k];
        const std::int64_t wanted = elsewhere ? TiffText::kElsewhere : ifd + k;
        if (page == wanted) continue;
        if (page != TiffText::kNowhere)
          fail(fmt::format("gives plane {} the page {} and the page {}", first + k, page, wanted));
        if (!elsewhere && !pages.insert(wanted).second)
          fail(fmt::format("gives page {} to two planes", wanted));
        page = wanted;
      }
    }
  }

  const std::string& path_;
  TiffText& out_;
  pugi::xml_node pixels_;
};

}  // namespace

std::optional<TiffText> read_ome_text(const std::string& path, const std::string& description) {
  const std::size_t first = description.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == description.npos || description[first] != '<') return std::nullopt;
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(description.data(), description.size());
  if (!result) {
    check(description.find("OME") == description.npos,
          fmt::format("{}: its OME description is no XML: {} at byte {}. Write the image again.",
                      path, result.description(), result.offset));
    return std::nullopt;
  }
  if (local(document.document_element().name()) != "OME") return std::nullopt;
  TiffText out;
  OmeReader(path, out).read(document.document_element());
  return out;
}

}  // namespace acinus::imaging
