#pragma once
/// Settings of contact that a law depends on and that are no constants of its cells.

#include <functional>
#include <string>
#include <vector>

#include "runs/scene/key_values.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Values of the keys of the contact that `chosen` accepts.
std::vector<KeyValue> take_contact(ContactBlock contact,
                                   const std::function<bool(const Key&)>& chosen);

/// Values of the settings (Key::in_law), to the last digit.
std::vector<std::string> law_settings(const ContactBlock& contact);

}  // namespace acinus::runs
