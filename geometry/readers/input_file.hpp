#pragma once
/// User's file held in memory with a cursor, for error messages that name the place.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.hpp"

namespace acinus::geometry {

/// Input file, read at construction; the cursor then moves over its bytes. Tokens are
/// separated by white space. All failures throw Error (Exit::kBadInput) that begins "file:line:"
/// for text and "file: byte N:" once set_binary(true) was called.
class InputFile {
 public:
  /// Reads a file, or its first bytes. Throws Error when the path does not exist, is not a regular
  /// file or cannot be read.
  /// @param most  number of bytes to read, where only a header is of interest
  explicit InputFile(std::string path, std::size_t most = std::string::npos);

  const std::string& path() const { return path_; }
  std::string_view bytes() const { return bytes_; }
  std::size_t position() const { return position_; }
  void set_position(std::size_t position) { position_ = position; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  bool binary() const { return binary_; }
  void set_binary(bool binary) { binary_ = binary; }

  /// Skips a byte order mark, as Windows editors put it in front of UTF-8 text. Throws where the
  /// mark says UTF-16. For text files only, before anything is read.
  void skip_byte_order_mark();

  /// Next token, empty at the end of the file.
  std::string_view next_token();
  /// Next token, without moving the cursor.
  std::string_view peek_token() const;
  /// Rest of the current line without its end mark; the cursor goes to the next line.
  std::string_view next_line();
  /// Next token as a number; `what` names it in the error. "nan" and "inf" are numbers here.
  double next_double(std::string_view what);
  std::int64_t next_integer(std::string_view what);

  /// Throws unless n values of at least `bytes_each` bytes can still follow: a wrong count must not
  /// become a huge allocation. `what` names the array.
  void check_room(std::uint64_t n, std::uint64_t bytes_each, std::string_view what) const;

  /// "file:line" or "file: byte N" of a position.
  std::string where(std::size_t position) const;
  /// Position of the n-th token counted from `start`, for errors found after reading.
  std::size_t token_position(std::size_t start, std::size_t n) const;
  /// Throws Error at the last token read, or at a position.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_at(std::size_t position, const std::string& message) const;

 private:
  std::string path_;
  std::string bytes_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;  ///< position of the last token
  bool binary_ = false;
};

/// True for coordinates that are finite and small enough for products of three to be finite too.
bool is_coordinate(const Vec3& x);
inline constexpr const char* kCoordinateRule = "coordinates must be finite and below 1e15";

/// Parses a whole token as a number; false when it is not one. Underflow becomes 0, overflow
/// infinite.
bool parse_double(std::string_view token, double& value);
bool parse_integer(std::string_view token, std::int64_t& value);

/// Token in quotes, shortened and with unprintable bytes as '?', for a message.
std::string in_quotes(std::string_view token);

/// Extension of a path from its last dot on, in lower case: ".vtk"; empty when it has none.
std::string extension_of(const std::string& path);

/// Text without blanks at its ends.
std::string trimmed(std::string_view text, std::string_view blanks = " \t\r");

/// Fields of a line between separators, each without blanks at its ends; one field at least.
std::vector<std::string> split_fields(std::string_view line, char separator,
                                      std::string_view blanks = " \t\r");

/// Text with ASCII letters in lower case.
std::string lower_case(std::string_view text);

}  // namespace acinus::geometry
