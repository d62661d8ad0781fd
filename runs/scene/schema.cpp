#include "runs/scene/schema.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/units/units.hpp"
#include "runs/scene/registry.hpp"
#include "runs/scene/visitor.hpp"

namespace acinus::runs {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kNamePattern = "^[A-Za-z0-9_-]{1,100}$";
constexpr const char* kLabelPattern = "^[A-Za-z0-9_ -]{1,100}$";

/// Builds one object schema per block; the innermost open one is the last of the stack.
class SchemaBuilder final : public Visitor {
 public:
  SchemaBuilder() { stack_.push_back(block_schema()); }

  void real(const Key& key, double& value) override {
    OrderedJson schema = real_schema(key);
    set_default(key, schema, real_json(key, value));
    put(key, std::move(schema));
  }
  void optional_real(const Key& key, std::optional<double>&) override {
    OrderedJson schema;
    schema["anyOf"] = OrderedJson::array({OrderedJson{{"const", "auto"}}, real_schema(key)});
    set_default(key, schema, "auto");
    put(key, std::move(schema));
  }
  void integer(const Key& key, int& value) override {
    OrderedJson schema = integer_schema(key);
    set_default(key, schema, value);
    put(key, std::move(schema));
  }
  void seed(const Key& key, std::uint64_t& value) override {
    put(key, OrderedJson{{"type", "integer"}, {"minimum", 0}, {"default", value}});
  }
  void flag(const Key& key, bool& value) override {
    put(key, OrderedJson{{"type", "boolean"}, {"default", value}});
  }
  void text(const Key& key, std::string& value) override {
    OrderedJson schema{{"type", "string"}};
    if (key.choices[0] && !key.is_file) {
      schema["enum"] = choices_of(key);
      if (key.automatic[0]) schema["enum"].push_back("auto");
    }
    if (key.is_name) schema["pattern"] = kNamePattern;
    if (key.is_label) schema["pattern"] = kLabelPattern;
    set_default(key, schema, key.automatic[0] ? "auto" : value);
    put(key, std::move(schema));
  }
  void vector(const Key& key, Vec3& value) override {
    OrderedJson schema = three(real_schema(key));
    set_default(key, schema,
                OrderedJson::array({real_json(key, value.x()), real_json(key, value.y()),
                                    real_json(key, value.z())}));
    put(key, std::move(schema));
  }
  void box(const Key& key, std::optional<std::array<Vec3, 2>>&) override {
    const OrderedJson corners{
        {"type", "array"}, {"items", three(real_schema(key))}, {"minItems", 2}, {"maxItems", 2}};
    OrderedJson schema;
    schema["anyOf"] = OrderedJson::array({OrderedJson{{"type", "null"}}, corners});
    schema["default"] = nullptr;
    put(key, std::move(schema));
  }
  void counts(const Key& key, std::array<int, 3>& value) override {
    OrderedJson schema = three(integer_schema(key));
    set_default(key, schema, value);
    put(key, std::move(schema));
  }
  void integers(const Key& key, std::vector<std::int64_t>& values) override {
    OrderedJson schema{{"type", "array"}, {"items", integer_schema(key)}};
    set_default(key, schema, values);
    put(key, std::move(schema));
  }
  void texts(const Key& key, std::vector<std::string>& values) override {
    OrderedJson schema{{"type", "array"},
                       {"items", OrderedJson{{"type", "string"}, {"minLength", 1}}}};
    set_default(key, schema, values);
    put(key, std::move(schema));
  }
  void value(const Key& key, std::optional<Node>&) override {
    put(key, OrderedJson{{"type", OrderedJson::array({"number", "string"})}});
  }
  void values(const Key& key, std::vector<Node>&) override {
    put(key, OrderedJson{{"type", "array"}});
  }
  void settings(const Key& key, std::vector<JsonMember>&) override {
    put(key, OrderedJson{{"type", "object"}});
  }
  void object(const Key& key, const Members& members) override { put(key, inner(members)); }
  void optional_object(const Key& key, bool, const std::function<void(bool)>&,
                       const Members& members) override {
    OrderedJson schema;
    schema["anyOf"] = OrderedJson::array({OrderedJson{{"type", "null"}}, inner(members)});
    schema["default"] = nullptr;
    put(key, std::move(schema));
  }
  void list(const Key& key, const Elements& elements) override {
    OrderedJson schema{{"type", "array"}};
    schema["items"] = inner([&](Visitor& visitor) { elements.visit_sample(visitor); });
    schema["default"] = OrderedJson::array();
    put(key, std::move(schema));
  }
  void map(const Key& key, const Elements& elements) override {
    OrderedJson schema{{"type", "object"}, {"minProperties", key.required ? 1 : 0}};
    schema["propertyNames"] = OrderedJson{{"pattern", kNamePattern}};
    schema["additionalProperties"] =
        inner([&](Visitor& visitor) { elements.visit_sample(visitor); });
    put(key, std::move(schema));
  }
  void when(bool, const char*, const Members& members) override {
    conditional_ = true;  // a key that is required only sometimes is not required for the schema
    members(*this);
    conditional_ = false;
  }

  OrderedJson finished() { return std::move(stack_.front()); }

 private:
  static OrderedJson block_schema() {
    OrderedJson schema{{"type", "object"}};
    schema["additionalProperties"] = false;
    schema["properties"] = OrderedJson::object();
    return schema;
  }

  static OrderedJson real_schema(const Key& key) {
    if (key.unit[0]) {
      // The unit is checked by the program: as a pattern it would have to list every spelling.
      return OrderedJson{
          {"type", "string"},
          {"pattern", "^ *[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)? *[^0-9 ].*$"},
          {"examples", OrderedJson::array({dimension_example(key.dimension)})},
          {"$comment", dimension_formula(key.dimension)}};
    }
    OrderedJson schema{{"type", "number"}};
    if (key.any_unit) schema["type"] = OrderedJson::array({"number", "string"});
    add_bounds(key, schema);
    return schema;
  }

  static OrderedJson integer_schema(const Key& key) {
    OrderedJson schema{{"type", "integer"}};
    if (key.choices[0]) {
      schema["enum"] = OrderedJson::array();
      for (const std::string& choice : choices_of(key)) schema["enum"].push_back(std::stoi(choice));
    }
    add_bounds(key, schema);
    return schema;
  }

  static void add_bounds(const Key& key, OrderedJson& schema) {
    if (std::isfinite(key.range.low)) {
      schema[key.range.low_open ? "exclusiveMinimum" : "minimum"] = key.range.low;
    }
    if (std::isfinite(key.range.high)) {
      schema[key.range.high_open ? "exclusiveMaximum" : "maximum"] = key.range.high;
    }
  }

  static OrderedJson three(OrderedJson items) {
    return OrderedJson{
        {"type", "array"}, {"items", std::move(items)}, {"minItems", 3}, {"maxItems", 3}};
  }

  static OrderedJson real_json(const Key& key, double value) {
    if (key.unit[0]) return format_quantity(value, key.dimension, key.unit);
    return value;
  }

  static void set_default(const Key& key, OrderedJson& schema, OrderedJson value) {
    if (!key.required) schema["default"] = std::move(value);
  }

  OrderedJson inner(const Members& members) {
    stack_.push_back(block_schema());
    const bool conditional = std::exchange(conditional_, false);
    members(*this);
    conditional_ = conditional;
    OrderedJson schema = std::move(stack_.back());
    stack_.pop_back();
    return schema;
  }

  void put(const Key& key, OrderedJson schema) {
    std::string meaning = key.meaning;
    const std::string range =
        key.unit[0] ? range_text(key.range, key.dimension, key.unit) : std::string();
    if (!range.empty()) meaning += ". Range: " + range;
    if (key.automatic[0]) meaning += std::string(". \"auto\": ") + key.automatic;
    if (key.symbol[0]) meaning += std::string(". Paper: ") + key.symbol;
    schema["description"] = meaning;
    if (key.required && !conditional_) stack_.back()["required"].push_back(key.name);
    stack_.back()["properties"][key.name] = std::move(schema);
  }

  std::vector<OrderedJson> stack_;
  bool conditional_ = false;
};

}  // namespace

std::string make_schema(const char* title, const char* extends,
                        const std::function<void(Visitor&)>& describe) {
  SchemaBuilder builder;
  describe(builder);
  OrderedJson root;
  root["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  root["title"] = title;
  root.update(builder.finished());
  root["properties"]["extends"] = OrderedJson{{"type", "string"}, {"description", extends}};
  root["properties"]["$schema"] = OrderedJson{{"type", "string"}};
  // What extends another may leave the required keys to it.
  if (root.contains("required")) {
    OrderedJson required = std::move(root["required"]);
    root.erase("required");
    root["anyOf"] =
        OrderedJson::array({OrderedJson{{"required", std::move(required)}},
                            OrderedJson{{"required", OrderedJson::array({"extends"})}}});
  }
  return root.dump(2) + "\n";
}

std::string scene_schema() {
  Scene scene;
  return make_schema("acinus scene",
                     "scene file this one changes, relative to this file: blocks are merged",
                     [&scene](Visitor& visitor) { describe(visitor, scene); });
}

}  // namespace acinus::runs
