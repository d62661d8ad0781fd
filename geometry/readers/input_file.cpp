#include "geometry/readers/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.hpp"

namespace acinus::geometry {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view strip_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+')
    token.remove_prefix(1);
  return token;
}

}  // namespace

InputFile::InputFile(std::string path, std::size_t most) : path_(std::move(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  check(std::filesystem::exists(status),
        fmt::format("{}: no such file. Check the path; a relative one in a scene starts at the "
                    "scene's folder.",
                    path_));
  check(std::filesystem::is_regular_file(status),
        fmt::format("{}: is a folder or a device, not a file. Give the path of the file itself.",
                    path_));
  std::ifstream stream(path_, std::ios::binary);
  check(stream.good(), fmt::format("{}: cannot be opened. Check its permissions.", path_));
  const auto size = std::min<std::uintmax_t>(std::filesystem::file_size(path_, ignored), most);
  check(!ignored, fmt::format("{}: cannot be read. Check its permissions.", path_));
  bytes_.resize(size);
  stream.read(bytes_.data(), static_cast<std::streamsize>(size));
  check(static_cast<std::uintmax_t>(stream.gcount()) == size,
        fmt::format("{}: only {} of {} bytes could be read. Check the disk.", path_,
                    stream.gcount(), size));
  check(size > 0, fmt::format("{}: the file is empty.", path_));
}

void InputFile::skip_byte_order_mark() {
  const std::string_view text = bytes_;
  if (text.starts_with("\xef\xbb\xbf")) position_ = 3;
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    fail("the file is UTF-16 text. Save it as UTF-8 or plain ASCII.");
}

std::string_view InputFile::next_token() {
  while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
  last_ = position_;
  while (position_ < bytes_.size() && !is_space(bytes_[position_])) ++position_;
  return std::string_view(bytes_).substr(last_, position_ - last_);
}

std::string_view InputFile::peek_token() const {
  std::size_t begin = position_;
  while (begin < bytes_.size() && is_space(bytes_[begin])) ++begin;
  std::size_t end = begin;
  while (end < bytes_.size() && !is_space(bytes_[end])) ++end;
  return std::string_view(bytes_).substr(begin, end - begin);
}

std::string_view InputFile::next_line() {
  last_ = position_;
  const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
  std::string_view line = std::string_view(bytes_).substr(position_, end - position_);
  position_ = std::min(end + 1, bytes_.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

double InputFile::next_double(std::string_view what) {
  const std::string_view token = next_token();
  if (token.empty())
    fail(fmt::format("the file ends where {} is expected. It looks truncated.", what));
  double value = 0;
  if (!parse_double(token, value)) {
    fail(fmt::format("found {} where {}, a number, is expected.", in_quotes(token), what));
  }
  return value;
}

std::int64_t InputFile::next_integer(std::string_view what) {
  const std::string_view token = next_token();
  if (token.empty())
    fail(fmt::format("the file ends where {} is expected. It looks truncated.", what));
  std::int64_t value = 0;
  if (!parse_integer(token, value)) {
    fail(fmt::format("found {} where {}, a whole number, is expected.", in_quotes(token), what));
  }
  return value;
}

void InputFile::check_room(std::uint64_t n, std::uint64_t bytes_each, std::string_view what) const {
  if (bytes_each == 0 || n <= remaining() / bytes_each) return;
  fail(fmt::format(
      "{} announces {} values, at least {} bytes each, but only {} bytes follow. The file "
      "is truncated or the count is wrong.",
      what, n, bytes_each, remaining()));
}

std::string InputFile::where(std::size_t position) const {
  if (binary_) return fmt::format("{}: byte {}", path_, position);
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(position, bytes_.size()));
  return fmt::format("{}:{}", path_, 1 + std::count(bytes_.begin(), end, '\n'));
}

std::size_t InputFile::token_position(std::size_t start, std::size_t n) const {
  std::size_t at = start;
  for (std::size_t token = 0; at < bytes_.size(); ++token) {
    while (at < bytes_.size() && is_space(bytes_[at])) ++at;
    if (token == n) break;
    while (at < bytes_.size() && !is_space(bytes_[at])) ++at;
  }
  return at;
}

void InputFile::fail(const std::string& message) const { fail_at(last_, message); }

void InputFile::fail_at(std::size_t position, const std::string& message) const {
  throw Error(where(position) + ": " + message);
}

bool is_coordinate(const Vec3& x) {
  constexpr double kMost = 1e15;
  return x.allFinite() && x.cwiseAbs().maxCoeff() < kMost;
}

bool parse_double(std::string_view token, double& value) {
  token = strip_plus(token);
  const char* end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  if (result.ptr != end || token.empty()) return false;
  if (result.ec == std::errc::result_out_of_range) {
    const bool tiny = token.find("e-") != token.npos || token.find("E-") != token.npos;
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  return result.ec == std::errc();
}

bool parse_integer(std::string_view token, std::int64_t& value) {
  token = strip_plus(token);
  const char* end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  return !token.empty() && result.ec == std::errc() && result.ptr == end;
}

std::string in_quotes(std::string_view token) {
  std::string text = "\"";
  for (const char c : token.substr(0, 40)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text + (token.size() > 40 ? "...\"" : "\"");
}

std::string extension_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  return dot == path.npos || path[dot] == '/' ? "" : lower_case(path.substr(dot));
}

std::string trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

std::vector<std::string> split_fields(std::string_view line, char separator,
                                      std::string_view blanks) {
  std::vector<std::string> fields;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = std::min(line.find(separator, from), line.size());
    fields.push_back(trimmed(line.substr(from, to - from), blanks));
    from = to + 1;
  }
  return fields;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

}  // namespace acinus::geometry
