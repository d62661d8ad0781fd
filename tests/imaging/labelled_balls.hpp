#pragma once
/// Label images of balls.

#include <string>
#include <vector>

#include "imaging/import_options.hpp"
#include "imaging/write_image.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/images.hpp"

namespace acinus::imaging {

struct LabelledBall {
  Label label;
  Vec3 center;
  double radius;
};

/// Balls in an image of 60 x 40 x 40 um; later ones cover earlier ones.
inline LabelImage balls(const std::vector<LabelledBall>& all) {
  return make_image({60, 40, 40}, Vec3::Ones(), [&](const Vec3& x) {
    Label label = 0;
    for (const LabelledBall& b : all)
      if ((x - b.center).norm() < b.radius) label = b.label;
    return label;
  });
}

/// Writes an image into a folder.
/// @return options that import it
inline ImportOptions options_for(const geometry::TempFolder& folder, const LabelImage& image) {
  ImportOptions o;
  o.image = folder.path() + "/labels.mha";
  write_image(o.image, image);
  return o;
}

inline const std::vector<LabelledBall> kTwoBalls{{3, {15, 20, 20}, 8}, {9, {29, 20, 20}, 8}};

}  // namespace acinus::imaging
