#pragma once
/// JSON text as a tree in which every value knows the file, line and column it came from.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace acinus::runs {

inline constexpr int kMaxDepth = 64;                 ///< nesting; deeper texts are an error
inline constexpr std::size_t kMaxBytes = 64u << 20;  ///< of one scene file
inline constexpr std::size_t kMaxValues = 4u << 20;  ///< of one scene file
inline constexpr std::size_t kMaxNames = 10000;      ///< of one object

/// Place in the text at which a value was written. Flags have line 0.
struct TextPlace {
  int source = 0;            ///< index into the sources of the document
  int line = 0, column = 0;  ///< from 1; columns count characters, not bytes
};

struct Source {
  std::string label;   ///< file name as the user gave it, or "--set a.b=c"
  std::string folder;  ///< relative paths inside this source start here
  bool is_flag = false;
};

struct JsonMember;

/// One JSON value.
struct Node {
  enum class Kind { kNull, kBoolean, kInteger, kNumber, kText, kList, kObject };
  Kind kind = Kind::kNull;
  bool boolean = false;
  bool negative = false;            ///< kInteger: the value is -(magnitude)
  std::uint64_t magnitude = 0;      ///< kInteger; of 1.0 or 1e3 up to 2^53
  double number = 0;                ///< kInteger and kNumber
  std::string text;                 ///< kText, valid UTF-8
  std::vector<Node> items;          ///< kList
  std::vector<JsonMember> members;  ///< kObject, in the order written, names unique
  TextPlace origin;

  const Node* find(std::string_view name) const;
  Node* find(std::string_view name);
};

struct JsonMember {
  std::string name;
  TextPlace origin;  ///< of the name
  Node value;
};

/// One mistake, not yet written out.
struct Complaint {
  TextPlace origin;
  std::string pointer;  ///< "/time/end"; "" = the whole text
  std::string message;  ///< starts with ": " or " = value: "
};

/// Sorts complaints by source, line and column and throws them as one Error, one line each;
/// returns if there are none.
void throw_complaints(const std::vector<Source>& sources, std::vector<Complaint> complaints);

/// Parses JSON with // and /* */ comments. The source's number goes into the origins.
/// @throws Error with "label:line:column": syntax, invalid UTF-8, a name given twice, nesting above
///         kMaxDepth, sizes above kMaxBytes, kMaxValues or kMaxNames.
Node parse_json(const std::vector<Source>& sources, int source, const std::string& text);

/// Value as one line of JSON, whole.
std::string json_of(const Node& node);

/// Value as one line of JSON, cut after 60 characters.
std::string shown(const Node& node);

/// Name as it stands in a pointer: ~ and / escaped, control characters made visible, cut when
/// long.
std::string pointer_part(std::string_view name);

/// True if the bytes are UTF-8; else gives the offset of the first wrong byte.
bool is_utf8(std::string_view text, std::size_t* wrong_byte = nullptr);

/// Replaces every byte that is not UTF-8 by a question mark: names of files need not be UTF-8.
std::string as_utf8(std::string text);

}  // namespace acinus::runs
