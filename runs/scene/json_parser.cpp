/// Parser behind parse_json: nlohmann-json for the syntax, a cursor beside it for the places.

#include "runs/scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

using Json = nlohmann::json;

/// Walks the text token by token in step with the parser's events, each of which is exactly one
/// token. (Counting the characters the parser has taken would be off by one after numbers, where it
/// has to look one character ahead.)
class TokenCursor {
 public:
  explicit TokenCursor(std::string_view text) : text_(text) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
    line_start_ = at_;
  }

  /// Moves to the start of the next token and returns its place.
  TextPlace next(int source) {
    skip_gap();
    const TextPlace origin = here(source);
    skip_token();
    end_ = here(source);
    return origin;
  }

  /// Place of the next token without taking it: where a syntax error stands.
  TextPlace peek(int source) {
    skip_gap();
    return here(source);
  }

  /// Place of a byte at or after the present one.
  TextPlace at_byte(int source, std::size_t byte) {
    while (at_ < std::min(byte, text_.size())) step();
    return here(source);
  }

  /// Place just behind the last token.
  TextPlace end_of_last() const { return end_; }

  char previous_character() const { return last_; }
  bool at_end() const { return at_ >= text_.size(); }

 private:
  void step() {
    if (text_[at_] == '\n') {
      ++line_;
      line_start_ = at_ + 1;
      n_continuation_ = 0;
    } else if ((static_cast<unsigned char>(text_[at_]) & 0xC0) == 0x80) {
      ++n_continuation_;
    }
    ++at_;
  }

  TextPlace here(int source) const {
    return {source, line_, static_cast<int>(at_ - line_start_ - n_continuation_) + 1};
  }

  bool starts(std::string_view token) const { return text_.substr(at_, token.size()) == token; }

  void skip_gap() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == ':') {
        if (c == ',' || c == ':') last_ = c;
        step();
      } else if (starts("//")) {
        while (at_ < text_.size() && text_[at_] != '\n') step();
      } else if (starts("/*")) {
        const std::size_t close = text_.find("*/", at_ + 2);
        const std::size_t end = close == std::string_view::npos ? text_.size() : close + 2;
        while (at_ < end) step();
      } else {
        return;
      }
    }
  }

  void skip_token() {
    if (at_ >= text_.size()) return;
    last_ = text_[at_];
    if (last_ == '"') {
      step();
      while (at_ < text_.size() && text_[at_] != '"') {
        if (text_[at_] == '\\' && at_ + 1 < text_.size()) step();
        step();
      }
      if (at_ < text_.size()) step();
    } else if (std::strchr("{}[]", last_)) {
      step();
    } else {  // a number or a literal; after a leading zero the number is over, as in 0|1
      if (last_ == '-') step();
      if (at_ + 1 < text_.size() && text_[at_] == '0' && text_[at_ + 1] >= '0' &&
          text_[at_ + 1] <= '9') {
        step();
        return;
      }
      while (at_ < text_.size() && !std::strchr(" \t\r\n,:{}[]/\"", text_[at_])) step();
    }
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0, n_continuation_ = 0;
  int line_ = 1;
  char last_ = '\0';
  TextPlace end_{};
};

/// True of the parser's words if it found a value or a name where the object or list ends or a
/// comma goes on with it.
bool is_about_separator(std::string_view what) {
  const bool expects = what.ends_with("expected '}'") || what.ends_with("expected ']'");
  const bool value = what.find("literal;") != std::string_view::npos ||
                     what.starts_with("unexpected '{'") || what.starts_with("unexpected '['");
  return expects && value;
}

/// Builds the tree from the parser's events.
class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(std::string_view text, int source) : cursor_(text), source_(source) {}

  bool null() override { return add({}); }
  bool boolean(bool value) override {
    Node node;
    node.kind = Node::Kind::kBoolean;
    node.boolean = value;
    return add(std::move(node));
  }
  bool number_integer(number_integer_t value) override {
    return add_integer(
        value < 0,
        value < 0 ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value),
        static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return add_integer(false, value, static_cast<double>(value));
  }
  /// Adds a number; 1.0 and 1e3 are whole numbers too, since programs write them so.
  bool number_float(number_float_t value, const string_t&) override {
    constexpr double kExact = 1ULL << 53;  // beyond, a double is one of several whole numbers
    if (std::floor(value) == value && std::abs(value) <= kExact)
      return add_integer(value < 0, static_cast<std::uint64_t>(std::abs(value)), value);
    Node node;
    node.kind = Node::Kind::kNumber;
    node.number = value;
    return add(std::move(node));
  }
  bool string(string_t& value) override {
    Node node;
    node.kind = Node::Kind::kText;
    node.text = std::move(value);
    return add(std::move(node));
  }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(Node::Kind::kObject); }
  bool start_array(std::size_t) override { return open(Node::Kind::kList); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    name_origin_ = cursor_.next(source_);
    if (open_.back().names.size() >= kMaxNames) {
      return stop(name_origin_, pointer(), fmt::format(": more than {} names", kMaxNames));
    }
    if (const auto [known, fresh] = open_.back().names.emplace(name, name_origin_); !fresh) {
      return stop(
          name_origin_, pointer() + "/" + pointer_part(name),
          fmt::format(": given twice, first in line {}. Keep one of them", known->second.line));
    }
    name_ = std::move(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing
    // value - the part worth showing"
    std::string what = error.what();
    const auto drop_through = [&what](const char* start, const char* end) {
      const auto found = what.find(end);
      if (what.starts_with(start) && found != std::string::npos) {
        what.erase(0, found + std::strlen(end));
      }
    };
    drop_through("[json.exception", "] ");
    drop_through("parse error", ": ");
    drop_through("syntax error", " - ");
    if (what.size() > 160) what = what.substr(0, 100) + " ... " + what.substr(what.size() - 40);
    const bool inside_token = what.starts_with("invalid string") &&
                              what.find("missing closing quote") == std::string::npos;
    const TextPlace before = cursor_.end_of_last();
    TextPlace origin = inside_token && position > 0 ? cursor_.at_byte(source_, position - 1)
                                                    : cursor_.peek(source_);
    const bool apart = before.line != origin.line || before.column != origin.column;
    if (is_about_separator(what) && apart && cursor_.previous_character() != ',') {
      what += ". Is there a comma missing here?";
      origin = before;
    }
    if (cursor_.previous_character() == ',' && !inside_token &&
        (what.find("'}'") != std::string::npos || what.find("']'") != std::string::npos)) {
      what += ". Is there a comma too many?";
    }
    return stop(origin, pointer(), ": not valid JSON: " + what);
  }

  std::vector<Complaint> complaints;
  Node root;

 private:
  struct Open {
    Node node;
    std::string name;  ///< in the object above
    TextPlace name_origin;
    std::map<std::string, TextPlace> names;
  };

  bool add_integer(bool negative, std::uint64_t magnitude, double number) {
    Node node;
    node.kind = Node::Kind::kInteger;
    node.negative = negative;
    node.magnitude = magnitude;
    node.number = number;
    return add(std::move(node));
  }

  bool add(Node node) {
    node.origin = cursor_.next(source_);
    return place(std::move(node), std::move(name_), name_origin_);
  }

  bool place(Node node, std::string name, TextPlace name_origin) {
    if (++n_value_ > kMaxValues) {
      return stop(node.origin, "", fmt::format(": more than {} values in one file", kMaxValues));
    }
    if (open_.empty()) {
      root = std::move(node);
    } else if (Node& parent = open_.back().node; parent.kind == Node::Kind::kList) {
      parent.items.push_back(std::move(node));
    } else {
      parent.members.push_back({std::move(name), name_origin, std::move(node)});
    }
    return true;
  }

  bool open(Node::Kind kind) {
    Open next;
    next.node.kind = kind;
    next.node.origin = cursor_.next(source_);
    next.name = std::move(name_);
    next.name_origin = name_origin_;
    if (open_.size() >= static_cast<std::size_t>(kMaxDepth)) {
      return stop(next.node.origin, "", fmt::format(": nested deeper than {} levels", kMaxDepth));
    }
    open_.push_back(std::move(next));
    return true;
  }

  bool close() {
    cursor_.next(source_);
    Open done = std::move(open_.back());
    open_.pop_back();
    return place(std::move(done.node), std::move(done.name), done.name_origin);
  }

  std::string pointer() const {
    std::string text;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (i == 0) continue;
      const Node& parent = open_[i - 1].node;
      text += "/" + (parent.kind == Node::Kind::kList ? std::to_string(parent.items.size())
                                                      : pointer_part(open_[i].name));
    }
    return text;
  }

  bool stop(TextPlace origin, std::string where, std::string message) {
    complaints.push_back({origin, std::move(where), std::move(message)});
    return false;
  }

  TokenCursor cursor_;
  int source_;
  std::vector<Open> open_;
  std::string name_;
  TextPlace name_origin_;
  std::size_t n_value_ = 0;
};

}  // namespace

Node parse_json(const std::vector<Source>& sources, int source, const std::string& text) {
  TokenCursor places(text);
  std::size_t wrong_byte = 0;
  if (text.size() > kMaxBytes) {
    throw_complaints(
        sources, {{{source, 1, 1},
                   "",
                   fmt::format(": has {} bytes; at most {} are read", text.size(), kMaxBytes)}});
  }
  if (!is_utf8(text, &wrong_byte)) {
    throw_complaints(sources, {{places.at_byte(source, wrong_byte), "",
                                fmt::format(": the byte 0x{:02x} is not UTF-8 text",
                                            static_cast<unsigned char>(text[wrong_byte]))}});
  }
  if (const auto zero = text.find('\0'); zero != std::string::npos) {
    throw_complaints(sources, {{places.at_byte(source, zero), "", ": a zero byte in the text"}});
  }
  TreeBuilder builder(text, source);
  const bool good = Json::sax_parse(text.begin(), text.end(), &builder,
                                    nlohmann::detail::input_format_t::json, true, true);
  throw_complaints(sources, builder.complaints);
  check(good, sources.at(source).label + ": not valid JSON");
  return std::move(builder.root);
}

}  // namespace acinus::runs
