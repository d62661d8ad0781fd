#include "runs/scene/choices.hpp"

#include <algorithm>
#include <string_view>

namespace acinus::runs {

std::string choice_name(const char* choices, int index) {
  std::string_view rest = choices;
  for (int k = 0; k < index && !rest.empty(); ++k)
    rest.remove_prefix(std::min(rest.size(), rest.find('|')) +
                       (rest.find('|') == rest.npos ? 0 : 1));
  return index < 0 ? "" : std::string(rest.substr(0, rest.find('|')));
}

int choice_index(const char* choices, const std::string& name) {
  if (name.empty()) return -1;
  std::string part;
  for (int k = 0; !(part = choice_name(choices, k)).empty(); ++k)
    if (part == name) return k;
  return -1;
}

}  // namespace acinus::runs
