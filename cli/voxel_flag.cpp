#include "cli/voxel_flag.hpp"

#include <sstream>
#include <vector>

#include "cli/command.hpp"
#include "core/units/dimension.hpp"

namespace acinus::cli {

Vec3 parse_voxel(const std::string& text) {
  constexpr const char* kFlag = "--voxel";
  std::vector<double> side;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');)
    side.push_back(quantity_of(
        kFlag, part.substr(std::min(part.find_first_not_of(' '), part.size())), kLength));
  if (side.size() == 1) return Vec3::Constant(side[0]);
  check(side.size() == 3,
        fmt::format(
            "{} \"{}\": give one length, or three with commas: \"0.5 um, 0.5 um, 1 um\" (x, y, "
            "z)",
            kFlag, text));
  return {side[0], side[1], side[2]};
}

}  // namespace acinus::cli
