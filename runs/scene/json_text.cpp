#include "runs/scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "core/error.hpp"

namespace acinus::runs {

const Node* Node::find(std::string_view name) const {
  for (const JsonMember& member : members) {
    if (member.name == name) return &member.value;
  }
  return nullptr;
}

Node* Node::find(std::string_view name) {
  return const_cast<Node*>(std::as_const(*this).find(name));
}

bool is_utf8(std::string_view text, std::size_t* wrong_byte) {
  std::size_t at = 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  while (at < text.size()) {
    const unsigned char lead = byte(at);
    std::size_t n_more = 0;
    unsigned char low = 0x80, high = 0xBF;  // allowed second byte: no overlong forms, no surrogates
    if (lead < 0x80) {
      n_more = 0;
    } else if (lead >= 0xC2 && lead <= 0xDF) {
      n_more = 1;
    } else if (lead >= 0xE0 && lead <= 0xEF) {
      n_more = 2;
      if (lead == 0xE0) low = 0xA0;
      if (lead == 0xED) high = 0x9F;
    } else if (lead >= 0xF0 && lead <= 0xF4) {
      n_more = 3;
      if (lead == 0xF0) low = 0x90;
      if (lead == 0xF4) high = 0x8F;
    } else {
      if (wrong_byte) *wrong_byte = at;
      return false;
    }
    for (std::size_t i = 1; i <= n_more; ++i, low = 0x80, high = 0xBF) {
      if (at + i >= text.size() || byte(at + i) < low || byte(at + i) > high) {
        if (wrong_byte) *wrong_byte = at;
        return false;
      }
    }
    at += n_more + 1;
  }
  return true;
}

std::string as_utf8(std::string text) {
  for (std::size_t wrong = 0; !is_utf8(text, &wrong);) text[wrong] = '?';
  return text;
}

std::string pointer_part(std::string_view name) {
  constexpr std::size_t kLongest = 80;
  std::string cut(name.substr(0, kLongest));
  if (name.size() > kLongest) cut += "...";
  const std::string quoted =
      nlohmann::json(cut).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string part;
  for (const char c : quoted.substr(1, quoted.size() - 2)) {
    if (c == '~') {
      part += "~0";
    } else if (c == '/') {
      part += "~1";
    } else {
      part += c;
    }
  }
  return part;
}

std::string json_of(const Node& node) {
  const auto quoted = [](const std::string& text) { return nlohmann::json(text).dump(); };
  std::string text;
  if (node.kind == Node::Kind::kText) return quoted(node.text);
  if (node.kind == Node::Kind::kList) {
    for (const Node& item : node.items) text += (text.empty() ? "" : ", ") + json_of(item);
    return "[" + text + "]";
  }
  if (node.kind == Node::Kind::kObject) {
    for (const JsonMember& member : node.members)
      text += (text.empty() ? "" : ", ") + quoted(member.name) + ": " + json_of(member.value);
    return "{" + text + "}";
  }
  return shown(node);
}

std::string shown(const Node& node) {
  constexpr std::size_t kLongest = 60;
  std::string text;
  switch (node.kind) {
    case Node::Kind::kNull:
      text = "null";
      break;
    case Node::Kind::kBoolean:
      text = node.boolean ? "true" : "false";
      break;
    case Node::Kind::kInteger:
      text = fmt::format("{}{}", node.negative ? "-" : "", node.magnitude);
      break;
    case Node::Kind::kNumber:
      text = fmt::format("{}", node.number);
      break;
    case Node::Kind::kText:
      text = nlohmann::json(node.text.substr(0, 4 * kLongest))
                 .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
      break;
    case Node::Kind::kList: {
      text = "[";
      for (std::size_t i = 0; i < node.items.size() && text.size() <= kLongest; ++i) {
        text += (i > 0 ? ", " : "") + shown(node.items[i]);
      }
      text += "]";
      break;
    }
    case Node::Kind::kObject:
      text = node.members.empty() ? "{}" : "{...}";
      break;
  }
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;  // never inside a character
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

void throw_complaints(const std::vector<Source>& sources, std::vector<Complaint> complaints) {
  if (complaints.empty()) return;
  std::stable_sort(complaints.begin(), complaints.end(),
                   [](const Complaint& a, const Complaint& b) {
                     return std::tie(a.origin.source, a.origin.line, a.origin.column) <
                            std::tie(b.origin.source, b.origin.line, b.origin.column);
                   });
  constexpr std::size_t kMost = 200;  // a file of another kind would otherwise fill the terminal
  std::string text;
  for (std::size_t i = 0; i < std::min(complaints.size(), kMost); ++i) {
    const Complaint& complaint = complaints[i];
    const Source& source = sources.at(complaint.origin.source);
    if (i > 0) text += "\n";
    text += source.label;
    if (!source.is_flag) {
      text += fmt::format(":{}:{}", complaint.origin.line, complaint.origin.column);
    } else {
      text += ":";
    }
    text += " " + (complaint.pointer.empty() ? "/" : complaint.pointer) + complaint.message;
  }
  if (complaints.size() > kMost) {
    text += fmt::format("\n... and {} more", complaints.size() - kMost);
  }
  throw Error(text);
}

}  // namespace acinus::runs
