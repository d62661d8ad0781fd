#include "runs/scene/value_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/error.hpp"
#include "core/units/units.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
using Kind = Node::Kind;

/// Path fit for a message: no control characters, not endless.
std::string pointer_path(const std::string& path) {
  std::string text = path.substr(0, 500);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
  return text;
}

/// Message of parse_quantity without the text it starts with, which the report prints already.
std::string without_prefix(const std::string& message, const std::string& text) {
  const std::string prefix = "\"" + text + "\": ";
  return pointer_path(message.starts_with(prefix) ? message.substr(prefix.size()) : message);
}

/// Sizes in base units (um, s, nN) beyond which a quantity is no tissue's but a slip of the unit.
/// Within them squares and cubes stay numbers, in the single precision of the run file too.
Range possible_sizes(Dimension dimension) {
  // Light and chemistry are of other sizes than the mechanics of cells.
  const bool large = dimension == kPower || dimension == kMolarEnergy;
  return {.low = 1e-15, .high = dimension == kLength ? 1e6 : large ? 1e24 : 1e12};
}

/// Rule that a number breaks which is not whole or too large.
/// @param largest  that fits into the program's number
std::string whole_number_rule(const Node& node, const char* largest) {
  const bool is_number = node.kind == Kind::kInteger || node.kind == Kind::kNumber;
  if (!is_number || std::floor(node.number) != node.number)
    return "must be a whole number, without quotes";
  return fmt::format("is beyond the largest whole number here, {}", largest);
}

}  // namespace

bool ValueReader::is_object(const Node& node, const std::string& pointer) const {
  if (node.kind == Kind::kObject) return true;
  report_.add_value(node, pointer, "must be a block, { ... }");
  return false;
}

bool ValueReader::has_three(const Node& node, const std::string& pointer, const Key& key) const {
  if (node.kind == Kind::kList && node.items.size() == 3) return true;
  const std::string one = key.unit[0] ? "\"" + dimension_example(key.dimension) + "\"" : "1";
  report_.add_value(node, pointer,
                    fmt::format("must be a list of three, e.g. [{0}, {0}, {0}]", one));
  return false;
}

bool ValueReader::read_real(const Key& key, const Node& node, const std::string& pointer,
                            double& value) const {
  double number = 0;
  if (key.unit[0] == '\0') {
    if (node.kind != Kind::kInteger && node.kind != Kind::kNumber) {
      report_.add_value(
          node, pointer,
          fmt::format("must be a plain number, without unit and quotes: {}", key.meaning));
      return false;
    }
    number = node.number;
  } else if (node.kind == Kind::kInteger || node.kind == Kind::kNumber) {
    report_.add_value(node, pointer,
                      fmt::format("a bare number; needed {} as a text with its unit, e.g. \"{}\"",
                                  dimension_name(key.dimension), dimension_example(key.dimension)));
    return false;
  } else if (node.kind != Kind::kText) {
    report_.add_value(node, pointer,
                      fmt::format("must be {} as a text with its unit, e.g. \"{}\"",
                                  dimension_name(key.dimension), dimension_example(key.dimension)));
    return false;
  } else {
    try {
      number = parse_quantity(node.text, key.dimension);
    } catch (const Error& error) {
      report_.add_value(node, pointer, without_prefix(error.what(), node.text));
      return false;
    }
  }
  if (!key.range.contains(number)) {
    report_.add_value(node, pointer, "must be " + range_text(key.range, key.dimension, key.unit));
    return false;
  }
  const Range sizes = possible_sizes(key.dimension);
  if (key.unit[0] != '\0' && number != 0 && !sizes.contains(std::abs(number))) {
    report_.add_value(
        node, pointer,
        fmt::format("is no size of tissue: from {0:g} to {1:g} {2} is allowed, and 0. "
                    "Check its unit",
                    sizes.low, sizes.high, base_unit(key.dimension)));
    return false;
  }
  value = number;
  return true;
}

void ValueReader::read_vector(const Key& key, const Node& node, const std::string& pointer,
                              Vec3& value) const {
  if (!has_three(node, pointer, key)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const Node& item = node.items[axis];
    double number = 0;
    if (read_real(key, item, fmt::format("{}/{}", pointer, axis), number)) value[axis] = number;
  }
}

void ValueReader::read_integer(const Key& key, const Node& node, const std::string& pointer,
                               int& value) const {
  constexpr double kLargest = std::numeric_limits<int>::max();
  if (node.kind != Kind::kInteger || std::abs(node.number) > kLargest) {
    report_.add_value(node, pointer, whole_number_rule(node, "2147483647"));
    return;
  }
  const int number = static_cast<int>(node.number);
  const std::vector<std::string> choices = choices_of(key);
  if (!choices.empty() &&
      std::find(choices.begin(), choices.end(), std::to_string(number)) == choices.end()) {
    report_.add_value(node, pointer, fmt::format("must be one of {}", fmt::join(choices, ", ")));
  } else if (!key.range.contains(number)) {
    report_.add_value(node, pointer, "must be " + range_text(key.range, kDimensionless, ""));
  } else {
    value = number;
  }
}

bool ValueReader::read_long(const Key& key, const Node& node, const std::string& pointer,
                            std::int64_t& value) const {
  constexpr auto kLargest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (node.kind != Kind::kInteger || node.magnitude > kLargest) {
    report_.add_value(node, pointer, whole_number_rule(node, "2^63 - 1"));
    return false;
  }
  const auto magnitude = static_cast<std::int64_t>(node.magnitude);
  value = node.negative ? -magnitude : magnitude;
  if (key.range.contains(static_cast<double>(value))) return true;
  report_.add_value(node, pointer, "must be " + range_text(key.range, kDimensionless, ""));
  return false;
}

void ValueReader::read_file_name(const Key& key, const Node& node, const std::string& pointer,
                                 std::string& value) const {
  if (node.text.empty()) {
    if (key.required) report_.add_value(node, pointer, "must name a file");
    return;
  }
  const Source& source = document_.sources.at(node.origin.source);
  std::string path = (fs::path(source.folder) / node.text).lexically_normal().string();
  std::error_code code;
  const bool is_file = node.text.find('\0') == std::string::npos && fs::is_regular_file(path, code);
  if (!is_file) {
    const bool ships = key.shipped[0] != 0;
    const std::string shipped = ships ? find_shipped_file(key.shipped, node.text) : "";
    if (shipped.empty()) {
      const std::vector<std::string> names =
          ships ? shipped_names(key.shipped) : std::vector<std::string>{};
      report_.add_value(node, pointer,
                        "no such file: " + pointer_path(path) +
                            (names.empty() ? ""
                                           : fmt::format("; shipped {}: {}", key.shipped,
                                                         fmt::join(names, ", "))));
      return;
    }
    path = shipped;
  }
  value = path;
}

void ValueReader::read_run_name(const Node& node, const std::string& pointer,
                                std::string& value) const {
  if (node.text.empty()) return;
  const Source& source = document_.sources.at(node.origin.source);
  const std::string path = (fs::path(source.folder) / node.text).lexically_normal().string();
  std::error_code code;
  if (node.text.find('\0') != std::string::npos || !fs::is_directory(path, code)) {
    report_.add_value(node, pointer, "no such run folder: " + pointer_path(path));
  } else if (!fs::is_regular_file(path + "/start.h5", code)) {
    report_.add_value(node, pointer,
                      "that folder has no start.h5: its run has no start_up, or did not reach "
                      "t = 0 yet");
  } else {
    value = path;
  }
}

}  // namespace acinus::runs
