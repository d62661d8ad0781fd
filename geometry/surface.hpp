#pragma once
/// Plain triangle surface, as read from a file or generated.

#include <array>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace acinus::geometry {

struct Surface {
  std::vector<Vec3> node;                    ///< um
  std::vector<std::array<int, 3>> triangle;  ///< counter-clockwise seen from outside
};

}  // namespace acinus::geometry
