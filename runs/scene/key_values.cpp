#include "runs/scene/key_values.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

/// Goes into every block that is present and hands fields with one value on.
class ValueVisitor final : public Visitor {
 public:
  using Act = std::function<void(const Key&, const KeyField&)>;
  explicit ValueVisitor(const Act& act) : act_(act) {}

  void real(const Key& key, double& value) override { act_(key, &value); }
  void optional_real(const Key& key, std::optional<double>& value) override { act_(key, &value); }
  void integer(const Key& key, int& value) override { act_(key, &value); }
  void flag(const Key& key, bool& value) override { act_(key, &value); }
  void text(const Key& key, std::string& value) override { act_(key, &value); }
  void seed(const Key&, std::uint64_t&) override {}
  void vector(const Key&, Vec3&) override {}
  void box(const Key&, std::optional<std::array<Vec3, 2>>&) override {}
  void counts(const Key&, std::array<int, 3>&) override {}
  void integers(const Key&, std::vector<std::int64_t>&) override {}
  void texts(const Key&, std::vector<std::string>&) override {}
  void value(const Key&, std::optional<Node>&) override {}
  void values(const Key&, std::vector<Node>&) override {}
  void settings(const Key&, std::vector<JsonMember>&) override {}
  void object(const Key&, const Members& members) override { members(*this); }
  void optional_object(const Key&, bool present, const std::function<void(bool)>&,
                       const Members& members) override {
    if (present) members(*this);
  }
  void list(const Key&, const Elements& elements) override {
    for (std::size_t i = 0; i < elements.size(); ++i) elements.visit(*this, i);
  }
  void map(const Key&, const Elements& elements) override {
    for (std::size_t i = 0; i < elements.size(); ++i) elements.visit(*this, i);
  }
  void when(bool holds, const char*, const Members& members) override {
    if (holds) members(*this);
  }

 private:
  const Act& act_;
};

}  // namespace

void for_each_value(const std::function<void(Visitor&)>& describe,
                    const std::function<void(const Key&, const KeyField&)>& act) {
  ValueVisitor visitor(act);
  describe(visitor);
}

double number_in(const KeyField& field) {
  if (const auto* number = std::get_if<double*>(&field)) return **number;
  if (const auto* number = std::get_if<std::optional<double>*>(&field))
    return (*number)->value_or(0);
  if (const auto* number = std::get_if<int*>(&field)) return **number;
  ACINUS_ASSERT(false);
  return 0;
}

std::vector<KeyValue> take_values(const std::function<void(Visitor&)>& describe,
                                  const std::function<bool(const Key&)>& chosen) {
  std::vector<KeyValue> values;
  for_each_value(describe, [&](const Key& key, const KeyField& field) {
    if (chosen(key))
      std::visit([&values](const auto* value) { values.emplace_back(*value); }, field);
  });
  return values;
}

void put_values(const std::vector<KeyValue>& values, const std::function<void(Visitor&)>& describe,
                const std::function<bool(const Key&)>& chosen) {
  std::size_t next = 0;
  for_each_value(describe, [&](const Key& key, const KeyField& field) {
    if (!chosen(key)) return;
    std::visit(
        [&](auto* value) {
          *value = std::get<std::remove_pointer_t<decltype(value)>>(values.at(next));
        },
        field);
    ++next;
  });
}

}  // namespace acinus::runs
