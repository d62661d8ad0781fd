#include "runs/scene/key_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/spelling.hpp"
#include "runs/scene/value_reader.hpp"

namespace acinus::runs {
namespace fs = std::filesystem;

bool is_name(const std::string& text) {
  constexpr const char* kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !text.empty() && text.size() <= 100 &&
         text.find_first_not_of(kLetters) == std::string::npos;
}

namespace {
using Kind = Node::Kind;

/// True for a name that may have spaces inside.
bool is_label(std::string text) {
  if (text.empty() || text.front() == ' ' || text.back() == ' ') return false;
  std::erase(text, ' ');
  return is_name(text);
}

constexpr const char* kNameRule = "must be a name of letters, digits, _ and -";

/// Copies the document's values into the fields.
class KeyReader final : public Visitor {
 public:
  KeyReader(const Document& document, Report& report, const std::string& prefix)
      : report_(report), values_(document, report), prefix_(prefix) {
    frame_.node = &document.root;
    frame_.origin = document.root.origin;
  }

  void real(const Key& key, double& value) override {
    if (const Node* node = take(key)) values_.read_real(key, *node, pointer_of(key), value);
  }

  void optional_real(const Key& key, std::optional<double>& value) override {
    const Node* node = take(key);
    if (node == nullptr || is_auto(key, *node)) return;
    double number = 0;
    if (values_.read_real(key, *node, pointer_of(key), number)) value = number;
  }

  void integer(const Key& key, int& value) override {
    if (const Node* node = take(key)) values_.read_integer(key, *node, pointer_of(key), value);
  }

  void seed(const Key& key, std::uint64_t& value) override {
    const Node* node = take(key);
    if (node == nullptr) return;
    if (node->kind == Kind::kInteger && !node->negative) {
      value = node->magnitude;
    } else {
      const bool rounded = node->kind == Kind::kNumber && std::floor(node->number) == node->number;
      report_.add_value(*node, pointer_of(key),
                        std::string("must be a whole number from 0 to 2^64 - 1") +
                            (rounded ? ", beyond 2^53 written without point and exponent" : ""));
    }
  }

  void flag(const Key& key, bool& value) override {
    const Node* node = take(key);
    if (node == nullptr) return;
    if (node->kind == Kind::kBoolean) {
      value = node->boolean;
    } else {
      report_.add_value(*node, pointer_of(key), "must be true or false, without quotes");
    }
  }

  void text(const Key& key, std::string& value) override {
    const Node* node = take(key);
    if (node == nullptr || is_auto(key, *node)) return;
    const std::string pointer = pointer_of(key);
    if (node->kind != Kind::kText) {
      report_.add_value(*node, pointer, "must be a text in quotes");
    } else if (key.is_run) {
      values_.read_run_name(*node, pointer, value);
    } else if (const auto choices = choices_of(key);
               key.is_file &&
               std::find(choices.begin(), choices.end(), node->text) == choices.end()) {
      values_.read_file_name(key, *node, pointer, value);
    } else if (!choices.empty() &&
               std::find(choices.begin(), choices.end(), node->text) == choices.end()) {
      const std::string hint = nearest_name(node->text, choices);
      report_.add_value(*node, pointer,
                        hint.empty()
                            ? fmt::format("must be one of \"{}\"{}", fmt::join(choices, "\", \""),
                                          key.automatic[0] ? ", \"auto\"" : "")
                            : "unknown choice. " + did_you_mean(hint));
    } else if (key.is_name && !is_name(node->text)) {
      report_.add_value(*node, pointer, kNameRule);
    } else if (key.is_label && !is_label(node->text)) {
      report_.add_value(*node, pointer, fmt::format("{}, with spaces inside if wanted", kNameRule));
    } else {
      value = node->text;
    }
  }

  void vector(const Key& key, Vec3& value) override {
    if (const Node* node = take(key)) values_.read_vector(key, *node, pointer_of(key), value);
  }

  void box(const Key& key, std::optional<std::array<Vec3, 2>>& value) override {
    const Node* node = take(key);
    if (node == nullptr || node->kind == Kind::kNull) return;
    const std::string pointer = pointer_of(key);
    if (node->kind != Kind::kList || node->items.size() != 2) {
      report_.add_value(*node, pointer, "must be a list of two corners, the lower one first");
      return;
    }
    std::array<Vec3, 2> corners{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i < 2; ++i) {
      values_.read_vector(key, node->items[i], fmt::format("{}/{}", pointer, i), corners[i]);
    }
    value = corners;
  }

  void counts(const Key& key, std::array<int, 3>& value) override {
    const Node* node = take(key);
    const std::string pointer = pointer_of(key);
    if (node == nullptr || !values_.has_three(*node, pointer, key)) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values_.read_integer(key, node->items[axis], fmt::format("{}/{}", pointer, axis),
                           value[axis]);
    }
  }

  void integers(const Key& key, std::vector<std::int64_t>& values) override {
    const Node* node = take(key);
    if (node == nullptr) return;
    const std::string pointer = pointer_of(key);
    if (node->kind != Kind::kList) {
      report_.add_value(*node, pointer, "must be a list of whole numbers, e.g. [0, 1]");
      return;
    }
    values.clear();
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      std::int64_t number = 0;
      if (values_.read_long(key, node->items[i], fmt::format("{}/{}", pointer, i), number)) {
        values.push_back(number);
      }
    }
  }

  void texts(const Key& key, std::vector<std::string>& values) override {
    const Node* node = take(key);
    if (node == nullptr) return;
    const std::string pointer = pointer_of(key);
    const bool all_text =
        node->kind == Kind::kList && std::ranges::all_of(node->items, [](const Node& item) {
          return item.kind == Kind::kText && !item.text.empty();
        });
    if (!all_text) {
      report_.add_value(*node, pointer, "must be a list of names in quotes");
      return;
    }
    values.clear();
    for (const Node& item : node->items) values.push_back(item.text);
  }

  void value(const Key& key, std::optional<Node>& value) override {
    if (const Node* node = take(key)) value = *node;
  }

  void values(const Key& key, std::vector<Node>& values) override {
    const Node* node = take(key);
    if (node == nullptr) return;
    if (node->kind == Kind::kList) {
      values = node->items;
    } else {
      report_.add_value(*node, pointer_of(key), "must be a list, [ ... ]");
    }
  }

  void settings(const Key& key, std::vector<JsonMember>& members) override {
    const Node* node = take(key);
    if (node != nullptr && values_.is_object(*node, pointer_of(key))) members = node->members;
  }

  void object(const Key& key, const Members& members) override {
    const Node* node = take(key);
    if (node != nullptr && !values_.is_object(*node, pointer_of(key))) return;
    enter(key.name, short_path(key.name), node, [&] { members(*this); });
  }

  void optional_object(const Key& key, bool, const std::function<void(bool)>& set_present,
                       const Members& members) override {
    const Node* node = take(key);
    const bool present = node != nullptr && node->kind != Kind::kNull;
    if (present && !values_.is_object(*node, pointer_of(key))) return;
    set_present(present);
    if (present) enter(key.name, short_path(key.name), node, [&] { members(*this); });
  }

  void list(const Key& key, const Elements& elements) override {
    const Node* node = take(key);
    if (node == nullptr) return;
    if (node->kind != Kind::kList) {
      report_.add_value(*node, pointer_of(key), "must be a list, [ ... ]");
      return;
    }
    elements.resize(node->items.size());
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const Node& item = node->items[i];
      const std::string part = fmt::format("{}/{}", key.name, i);
      if (!values_.is_object(item, frame_.pointer + "/" + part)) continue;
      enter(part, std::string(key.item) + ".", &item, [&] { elements.visit(*this, i); });
    }
  }

  void map(const Key& key, const Elements& elements) override {
    const Node* node = take(key);
    if (node == nullptr || !values_.is_object(*node, pointer_of(key))) return;
    for (const JsonMember& member : node->members) {
      if (is_name(member.name)) {
        elements.add(member.name);
      } else {
        report_.add(member.origin, pointer_of(key) + "/" + pointer_part(member.name), kNameRule);
      }
    }
    if (key.required && node->members.empty()) {
      report_.add(node->origin, pointer_of(key), "is empty: " + std::string(key.meaning));
    }
    const std::vector<std::string> names = elements.names();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Node* item = node->find(names[i]);
      const std::string part = fmt::format("{}/{}", key.name, names[i]);
      if (!values_.is_object(*item, frame_.pointer + "/" + part)) continue;
      enter(part, std::string(key.item) + ".", item, [&] { elements.visit(*this, i); });
    }
  }

  void when(bool holds, const char* condition, const Members& members) override {
    const std::string text = condition;
    const std::string controlling = frame_.pointer + "/" + text.substr(0, text.find(' '));
    // A bad or missing controlling key is reported once; what depends on it is left alone.
    frame_.mode = holds ? Mode::kRead : report_.is_bad(controlling) ? Mode::kIgnore : Mode::kForbid;
    frame_.condition = condition;
    members(*this);
    frame_.mode = Mode::kRead;
  }

  /// Reports the members of the innermost block that no key has asked for.
  void finish_block() {
    if (frame_.node == nullptr) return;
    for (const JsonMember& member : frame_.node->members) {
      if (std::find(frame_.known.begin(), frame_.known.end(), member.name) != frame_.known.end()) {
        continue;
      }
      const std::string hint = nearest_name(member.name, frame_.known);
      std::string message = "unknown key. ";
      if (frame_.pointer.empty() && member.name == "cell") {
        message +=
            "Constants of cells are in cell_types.NAME, of which `acinus explain` writes cell";
      } else if (!hint.empty()) {
        message += did_you_mean(hint) +
                   fmt::format(" (acinus explain {}{}{})", prefix_, frame_.short_path, hint);
      } else {
        message += fmt::format("Known here: {}", fmt::join(frame_.known, ", "));
      }
      report_.add(member.origin, frame_.pointer + "/" + pointer_part(member.name), message);
    }
  }

 private:
  enum class Mode { kRead, kIgnore, kForbid };
  struct OpenBlock {
    const Node* node = nullptr;  ///< the block read; nullptr = absent, all its keys at default
    TextPlace origin;            ///< of the nearest block that is in the text
    std::string pointer;         ///< "" or "/time"
    std::string short_path;      ///< "" or "time."
    std::vector<std::string> known;
    Mode mode = Mode::kRead;
    std::string condition;
  };

  std::string pointer_of(const Key& key) const { return frame_.pointer + "/" + key.name; }
  std::string short_path(const char* name) const { return frame_.short_path + name + "."; }

  /// Value of a key, nullptr if it is to stay at its default.
  const Node* take(const Key& key) {
    frame_.known.emplace_back(key.name);
    const Node* node = frame_.node != nullptr ? frame_.node->find(key.name) : nullptr;
    if (frame_.mode == Mode::kIgnore) return nullptr;
    if (frame_.mode == Mode::kForbid) {
      if (node != nullptr) {
        report_.add_value(*node, pointer_of(key),
                          fmt::format("is used only with {}. Remove it", frame_.condition));
      }
      return nullptr;
    }
    if (node == nullptr && key.required) {
      const std::string example =
          key.unit[0] ? fmt::format(", e.g. \"{}\"", dimension_example(key.dimension)) : "";
      report_.add(frame_.origin, pointer_of(key),
                  fmt::format("is missing: {}{} (acinus explain {}{}{})", key.meaning, example,
                              prefix_, frame_.short_path, key.name));
    }
    return node;
  }

  void enter(const std::string& part, const std::string& short_path, const Node* node,
             const std::function<void()>& members) {
    OpenBlock inner;
    inner.node = node;
    inner.origin = node != nullptr ? node->origin : frame_.origin;
    inner.pointer = frame_.pointer + "/" + part;
    inner.short_path = short_path;
    std::swap(frame_, inner);
    members();
    finish_block();
    std::swap(frame_, inner);
  }

  bool is_auto(const Key& key, const Node& node) const {
    return key.automatic[0] && node.kind == Kind::kText && node.text == "auto";
  }

  Report& report_;
  ValueReader values_;
  const std::string& prefix_;
  OpenBlock frame_;
};

}  // namespace

std::string default_name(const std::string& label) {
  std::string name = fs::path(label).stem().string().substr(0, 100);
  for (char& c : name) {
    if (!is_name(std::string(1, c))) c = '_';
  }
  return name.empty() ? "scene" : name;
}

void read_keys(const Document& document, Report& report,
               const std::function<void(Visitor&)>& describe, const std::string& prefix) {
  KeyReader reader(document, report, prefix);
  describe(reader);
  reader.finish_block();
}

}  // namespace acinus::runs
