#include "imaging/json_statements.hpp"

#include <nlohmann/json.hpp>

#include "geometry/readers/input_file.hpp"

namespace acinus::imaging {
namespace {

/// JSON object of a text; discarded where the text is not JSON, or no object.
nlohmann::json parse_object(const std::string& text) {
  constexpr std::size_t kMost = 1 << 20;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (text.size() > kMost || first == text.npos || text[first] != '{') return {};
  nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  return value.is_object() ? value : nlohmann::json();
}

}  // namespace

std::optional<std::vector<std::string>> read_axis_tags(const std::string& text) {
  const nlohmann::json tags = parse_object(text);
  if (!tags.contains("axes") || !tags["axes"].is_array()) return std::nullopt;
  std::vector<std::string> axes;
  for (const nlohmann::json& axis : tags["axes"]) {
    if (!axis.is_object() || !axis.contains("key") || !axis["key"].is_string()) return std::nullopt;
    axes.push_back(geometry::lower_case(axis["key"].get<std::string>()));
  }
  return axes;
}

std::optional<TiffShape> read_tiff_shape(const std::string& text) {
  const nlohmann::json said = parse_object(text);
  if (!said.contains("shape") || !said["shape"].is_array()) return std::nullopt;
  TiffShape shape;
  for (const nlohmann::json& n : said["shape"]) {
    if (!n.is_number_integer() || n.get<std::int64_t>() < 1) return std::nullopt;
    shape.length.push_back(n.get<std::int64_t>());
  }
  if (said.contains("axes") && said["axes"].is_string()) {
    shape.axes = said["axes"].get<std::string>();
    if (shape.axes.size() != shape.length.size()) return std::nullopt;
  }
  return shape;
}

}  // namespace acinus::imaging
