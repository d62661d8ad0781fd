#include "runs/scene/fault_report.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

namespace acinus::runs {
namespace {

/// Value one step down from `node`.
const Node* child(const Node& node, const std::string& part) {
  if (node.kind == Node::Kind::kList) {
    std::size_t index = 0;
    const auto [end, code] = std::from_chars(part.data(), part.data() + part.size(), index);
    const bool whole = code == std::errc() && end == part.data() + part.size();
    return whole && index < node.items.size() ? &node.items[index] : nullptr;
  }
  for (const JsonMember& member : node.members) {
    if (pointer_part(member.name) == part) return &member.value;
  }
  return nullptr;
}

/// Walks along the pointer as far as the text goes.
const Node* deepest(const Node& root, const std::string& pointer, bool* whole) {
  const Node* node = &root;
  std::size_t at = 0;
  while (at < pointer.size()) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const Node* next = child(*node, pointer.substr(at + 1, end - at - 1));
    if (next == nullptr) {
      *whole = false;
      return node;
    }
    node = next;
    at = end;
  }
  *whole = true;
  return node;
}

}  // namespace

void Report::keep(Complaint complaint) {
  constexpr std::size_t kMost = 10000;  // more would only fill memory
  if (complaints_.size() >= kMost) return;
  bad_.insert(complaint.pointer);
  complaints_.push_back(std::move(complaint));
}

void Report::add(TextPlace origin, const std::string& pointer, const std::string& message) {
  keep({origin, pointer, ": " + message});
}

void Report::add_value(const Node& node, const std::string& pointer, const std::string& message) {
  keep({node.origin, pointer, " = " + shown(node) + ": " + message});
}

void Report::add_relation(std::initializer_list<std::string> pointers, const std::string& value,
                          const std::string& message) {
  const Node* place = nullptr;
  for (const std::string& pointer : pointers) {
    if (is_bad(pointer)) return;
    if (place == nullptr) place = find(pointer);
  }
  const std::string& first = *pointers.begin();
  if (place == nullptr) {
    bool whole = false;
    place = deepest(document_.root, first, &whole);
  }
  const Node* node = find(first);
  const std::string text = node != nullptr ? shown(*node) : value;
  keep({place->origin, first, (text.empty() ? "" : " = " + text) + ": " + message});
}

bool Report::is_bad(const std::string& pointer) const {
  for (std::size_t end = pointer.size(); end > 0; end = pointer.rfind('/', end - 1)) {
    if (bad_.count(pointer.substr(0, end)) > 0) return true;
  }
  for (const char* component : {"/0", "/1", "/2"}) {
    if (bad_.count(pointer + component) > 0) return true;
  }
  return false;
}

const Node* Report::find(const std::string& pointer) const {
  bool whole = false;
  const Node* node = deepest(document_.root, pointer, &whole);
  return whole ? node : nullptr;
}

void Report::finish() const { throw_complaints(document_.sources, complaints_); }

}  // namespace acinus::runs
