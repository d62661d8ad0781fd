#pragma once
/// Name, unit and meaning of a measured series.

#include <string>
#include <vector>

namespace acinus::runs {

/// Column of /observables in the run file.
struct Observable {
  std::string name;     ///< ends in its unit where there is one
  std::string unit;     ///< of the values, "1" if there is none
  std::string meaning;  ///< one line
};

/// Adds further observables to a list.
inline void append(std::vector<Observable>& list, const std::vector<Observable>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace acinus::runs
