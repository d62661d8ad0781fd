#include "runs/scene/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/units/units.hpp"
#include "runs/scene/json_text.hpp"
#include "runs/scene/registry.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {
namespace {

std::string in_quotes(const std::string& text) { return nlohmann::json(as_utf8(text)).dump(); }

class JsonWriter final : public Visitor {
 public:
  /// @param start_state  replaces the folder of the run a scene starts from when folders are left
  /// out
  JsonWriter(bool with_folders, std::string start_state)
      : with_folders_(with_folders), start_state_(std::move(start_state)) {}

  void real(const Key& key, double& value) override { line(key.name, number(key, value)); }
  void optional_real(const Key& key, std::optional<double>& value) override {
    line(key.name, value ? number(key, *value) : "\"auto\"");
  }
  void integer(const Key& key, int& value) override { line(key.name, std::to_string(value)); }
  void seed(const Key& key, std::uint64_t& value) override {
    line(key.name, std::to_string(value));
  }
  void flag(const Key& key, bool& value) override { line(key.name, value ? "true" : "false"); }
  void text(const Key& key, std::string& value) override {
    if (key.automatic[0] && value.empty()) {
      line(key.name, "\"auto\"");
    } else if (key.is_run && !with_folders_) {
      line(key.name, in_quotes(start_state_));
    } else if (key.is_file && !with_folders_) {
      line(key.name, in_quotes(std::filesystem::path(value).filename().string()));
    } else {
      line(key.name, in_quotes(value));
    }
  }
  void vector(const Key& key, Vec3& value) override { line(key.name, three(key, value)); }
  void box(const Key& key, std::optional<std::array<Vec3, 2>>& value) override {
    line(key.name, value ? fmt::format("[{}, {}]", three(key, (*value)[0]), three(key, (*value)[1]))
                         : "null");
  }
  void counts(const Key& key, std::array<int, 3>& value) override {
    line(key.name, fmt::format("[{}]", fmt::join(value, ", ")));
  }
  void integers(const Key& key, std::vector<std::int64_t>& values) override {
    line(key.name, fmt::format("[{}]", fmt::join(values, ", ")));
  }
  void texts(const Key& key, std::vector<std::string>& values) override {
    std::vector<std::string> quoted;
    for (const std::string& value : values) quoted.push_back(in_quotes(value));
    line(key.name, fmt::format("[{}]", fmt::join(quoted, ", ")));
  }
  void value(const Key& key, std::optional<Node>& value) override {
    line(key.name, value ? json_of(*value) : "null");
  }
  void values(const Key& key, std::vector<Node>& values) override {
    std::vector<std::string> all;
    for (const Node& value : values) all.push_back(json_of(value));
    line(key.name, fmt::format("[{}]", fmt::join(all, ", ")));
  }
  void settings(const Key& key, std::vector<JsonMember>& members) override {
    Node all;
    all.kind = Node::Kind::kObject;
    all.members = members;
    line(key.name, json_of(all));
  }
  void object(const Key& key, const Members& members) override {
    open(key.name, '{');
    members(*this);
    close('}');
  }
  void optional_object(const Key& key, bool present, const std::function<void(bool)>&,
                       const Members& members) override {
    if (present) {
      object(key, members);
    } else {
      line(key.name, "null");
    }
  }
  void list(const Key& key, const Elements& elements) override {
    if (elements.size() == 0) {
      line(key.name, "[]");
      return;
    }
    open(key.name, '[');
    for (std::size_t i = 0; i < elements.size(); ++i) {
      open("", '{');
      elements.visit(*this, i);
      close('}');
    }
    close(']');
  }
  void map(const Key& key, const Elements& elements) override {
    open(key.name, '{');
    const std::vector<std::string> names = elements.names();
    for (std::size_t i = 0; i < names.size(); ++i) {
      open(names[i], '{');
      elements.visit(*this, i);
      close('}');
    }
    close('}');
  }
  void when(bool holds, const char*, const Members& members) override {
    if (holds) members(*this);
  }

  std::string finished() { return "{" + text_ + "\n}\n"; }

 private:
  static std::string three(const Key& key, const Vec3& value) {
    return fmt::format("[{}, {}, {}]", number(key, value.x()), number(key, value.y()),
                       number(key, value.z()));
  }

  static std::string number(const Key& key, double value) {
    const std::string text = format_quantity(value, key.dimension, key.unit);
    return key.unit[0] ? "\"" + text + "\"" : text;
  }

  void start(const std::string& name) {
    if (!first_) text_ += ",";
    first_ = false;
    text_ += "\n" + std::string(2 * depth_, ' ');
    if (!name.empty()) text_ += in_quotes(name) + ": ";
  }
  void line(const std::string& name, const std::string& value) {
    start(name);
    text_ += value;
  }
  void open(const std::string& name, char bracket) {
    start(name);
    text_ += bracket;
    ++depth_;
    first_ = true;
  }
  void close(char bracket) {
    --depth_;
    text_ += "\n" + std::string(2 * depth_, ' ') + bracket;
    first_ = false;
  }

  bool with_folders_;
  std::string start_state_;
  std::string text_;
  std::size_t depth_ = 1;
  bool first_ = true;
};

std::string write(const Scene& scene, bool with_folders) {
  JsonWriter writer(with_folders, scene.start_state);
  Scene copy = scene;  // visitors take fields by reference; this one only reads
  describe(writer, copy);
  return writer.finished();
}

}  // namespace

std::string write_resolved(const Scene& scene) { return write(scene, true); }

std::string hash_scene(const Scene& scene) {
  const std::string text = write(scene, false);
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

void set_canonical(Scene& scene) {
  scene.resolved_json = write_resolved(scene);
  scene.hash = hash_scene(scene);
}

}  // namespace acinus::runs
