#include "imaging/background.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace acinus::imaging {
namespace {

/// Calls visit(label) for the outermost voxel layer of one side of the image.
template <class Visit>
void visit_side(const LabelImage& image, std::size_t axis, bool high, Visit visit) {
  Voxel low{}, end = image.size;
  (high ? low : end)[axis] = high ? image.size[axis] - 1 : 1;
  for (int z = low[2]; z < end[2]; ++z)
    for (int y = low[1]; y < end[1]; ++y)
      for (int x = low[0]; x < end[0]; ++x) visit(image.label[image.index({x, y, z})]);
}

/// Label other than 0 that fills at least this share of the outermost voxels on all six sides; 0 if
/// there is none.
Label find_enclosing(const LabelImage& image, double share) {
  Label found = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      std::map<Label, std::size_t> count;
      std::size_t all = 0;
      visit_side(image, axis, high, [&](Label l) {
        ++count[l];
        ++all;
      });
      const auto most = std::ranges::max_element(count, {}, [](const auto& c) { return c.second; });
      const bool enough = static_cast<double>(most->second) >= share * static_cast<double>(all);
      if (!enough || most->first == 0 || (found != 0 && most->first != found)) return 0;
      found = most->first;
    }
  return found;
}

}  // namespace

void clear_background(const ImportOptions& o, LabelImage& image) {
  if (o.background) {
    if (*o.background == 0) return;
    const auto n = std::ranges::count(image.label, *o.background);
    check(n > 0,
          fmt::format("{}: --background {}: no voxel has this label.", o.image, *o.background));
    std::ranges::replace(image.label, *o.background, Label{0});
    return;
  }
  constexpr double kLeastShare = 0.6;
  const Label label = find_enclosing(image, kLeastShare);
  if (label == 0 || label == o.vessel_label) return;
  const auto n = static_cast<double>(std::ranges::count(image.label, label));
  throw Error(fmt::format(
      "{}: label {} fills {:.0f} % of the image and most of its six sides: is it the background? "
      "Give --background {} if it is, --vessel-label {} if it is vessels, --background 0 if it is "
      "a cell.",
      o.image, label, 100 * n / static_cast<double>(image.label.size()), label, label));
}

}  // namespace acinus::imaging
