#include "runs/scene/choices.hpp"

#include <algorithm>

namespace acinus::runs {

std::vector<std::string> split_choices(const char* choices) {
  std::vector<std::string> names;
  std::string name;
  for (const char* c = choices; *c != '\0'; ++c) {
    if (*c == '|') {
      names.push_back(name);
      name.clear();
    } else {
      name += *c;
    }
  }
  if (!name.empty()) names.push_back(name);
  return names;
}

std::string choice_name(const char* choices, int index) {
  const std::vector<std::string> names = split_choices(choices);
  return index >= 0 && index < static_cast<int>(names.size()) ? names[index] : "";
}

int choice_index(const char* choices, const std::string& name) {
  const std::vector<std::string> names = split_choices(choices);
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

}  // namespace acinus::runs
