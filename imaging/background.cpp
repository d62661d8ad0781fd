#include "imaging/background.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace acinus::imaging {
namespace {

/// Number of voxels of each label in the outermost layer of one side of the image.
std::map<Label, std::size_t> count_side(const LabelRows& image, std::size_t axis, bool high) {
  std::map<Label, std::size_t> count;
  Voxel low{}, end = image.size;
  (high ? low : end)[axis] = high ? image.size[axis] - 1 : 1;
  for (int z = low[2]; z < end[2]; ++z)
    for (int y = low[1]; y < end[1]; ++y) {
      const LabelLine& line = image.line[image.line_index(y, z)];
      if (axis == 0)
        ++count[(high ? line.back() : line.front()).label];
      else
        for (std::size_t k = 0; k < line.size(); ++k)
          count[line[k].label] += line[k].end - first_of(line, k);
    }
  return count;
}

std::size_t count_label(const LabelRows& image, Label label) {
  std::size_t n = 0;
  for (const LabelLine& line : image.line)
    for (std::size_t k = 0; k < line.size(); ++k)
      if (line[k].label == label) n += line[k].end - first_of(line, k);
  return n;
}

/// Label other than 0 that fills at least this share of the outermost voxels on all six sides; 0 if
/// there is none.
Label find_enclosing(const LabelRows& image, double share) {
  Label found = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      const std::map<Label, std::size_t> count = count_side(image, axis, high);
      const std::size_t all = image.n_voxel() / image.size[axis];
      const auto most = std::ranges::max_element(count, {}, [](const auto& c) { return c.second; });
      const bool enough = static_cast<double>(most->second) >= share * static_cast<double>(all);
      if (!enough || most->first == 0 || (found != 0 && most->first != found)) return 0;
      found = most->first;
    }
  return found;
}

}  // namespace

void clear_background(const ImportOptions& o, LabelRows& image) {
  if (o.background) {
    if (*o.background == 0) return;
    bool any = false;
    for (LabelLine& line : image.line)
      for (LabelRow& row : line)
        if (row.label == *o.background) {
          row.label = 0;
          any = true;
        }
    check(any,
          fmt::format("{}: --background {}: no voxel has this label.", o.image, *o.background));
    return;
  }
  constexpr double kLeastShare = 0.6;
  const Label label = find_enclosing(image, kLeastShare);
  if (label == 0 || label == o.vessel_label) return;
  const auto n = static_cast<double>(count_label(image, label));
  throw Error(fmt::format(
      "{}: label {} fills {:.0f} % of the image and most of its six sides: is it the background? "
      "Give --background {} if it is, --vessel-label {} if it is vessels, --background 0 if it is "
      "a cell.",
      o.image, label, 100 * n / static_cast<double>(image.n_voxel()), label, label));
}

}  // namespace acinus::imaging
