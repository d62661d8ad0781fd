#pragma once
/// Values of single keys, chosen by their properties in the registry.

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runs/scene/visitor.hpp"

namespace acinus::runs {

/// Field of a key with one value; a choice is the text of its name.
using KeyField = std::variant<bool*, int*, double*, std::optional<double>*, std::string*>;

/// Value of such a field.
using KeyValue = std::variant<bool, int, double, std::optional<double>, std::string>;

/// Calls `act` for every key with one value that `describe` shows and that exists: not those of
/// blocks that are absent or of conditions that do not hold.
void for_each_value(const std::function<void(Visitor&)>& describe,
                    const std::function<void(const Key&, const KeyField&)>& act);

/// Field as a number, 0 for "auto". @pre it is a number
double number_in(const KeyField& field);

/// Values of the keys that `describe` shows and `chosen` accepts, in the registry's order.
std::vector<KeyValue> take_values(const std::function<void(Visitor&)>& describe,
                                  const std::function<bool(const Key&)>& chosen);

/// Puts values that were taken back, into the same keys of another block.
/// @pre the same keys exist in both
void put_values(const std::vector<KeyValue>& values, const std::function<void(Visitor&)>& describe,
                const std::function<bool(const Key&)>& chosen);

}  // namespace acinus::runs
