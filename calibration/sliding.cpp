#include "calibration/sliding.hpp"

#include <cmath>

#include "calibration/recovery.hpp"

namespace acinus::calibration {

double offset_of_layers(std::span<const Vec3> first, std::span<const Vec3> now) {
  double middle = 0;
  for (const Vec3& x : first) middle += x.z() / static_cast<double>(first.size());
  double sum[2] = {}, cells[2] = {};
  for (std::size_t k = 0; k < first.size(); ++k) {
    const int layer = first[k].z() > middle ? 1 : 0;
    sum[layer] += now[k].x();
    ++cells[layer];
  }
  return sum[1] / cells[1] - sum[0] / cells[0];
}

double steady_slide(const Slide& slide) {
  if (slide.time.empty()) return 0;
  const double end = slide.time.back();
  return slide.slid.back() - value_at(end / 3, slide.time, slide.slid);
}

}  // namespace acinus::calibration
