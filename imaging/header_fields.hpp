#pragma once
/// Fields of a text header, as of MetaImage and NRRD.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/readers/input_file.hpp"

namespace acinus::imaging {

/// Bytes at the start of a file that may be header.
inline constexpr std::size_t kMostHeader = 1 << 24;

/// Header fields by name in lower case, each with its place in the file for messages.
class HeaderFields {
 public:
  /// Makes an empty header. @param advice  on writing such a file, for messages
  HeaderFields(const geometry::InputFile& file, const char* advice)
      : file_(file), advice_(advice) {}

  /// Adds a field. Throws Error if it has another value already.
  void add(std::string_view name, std::string_view value, std::size_t place);
  bool has(const std::string& name) const { return field_.contains(name); }
  std::string text(const std::string& name) const;  ///< "" without such a field
  /// Numbers between spaces, commas and brackets; "none" is nan. Throws Error at other text.
  std::vector<double> numbers(const std::string& name) const;
  /// Numbers of voxels along three axes. Throws Error unless they are three whole numbers from 1.
  std::array<std::int64_t, 3> sizes(const std::string& name) const;
  /// One number; nothing without such a field. Throws Error at anything else.
  std::optional<double> number(const std::string& name) const;
  /// Throws Error at the field, with `what` and the advice.
  [[noreturn]] void fail(const std::string& name, const std::string& what) const;

 private:
  struct HeaderLine {
    std::string value;
    std::size_t place = 0;
  };
  const geometry::InputFile& file_;
  const char* advice_;
  std::map<std::string, HeaderLine> field_;
};

}  // namespace acinus::imaging
