#pragma once
/// Small label images for the tests of this folder.

#include <functional>

#include "core/image/label_image.hpp"

namespace acinus::image {

/// The label of every voxel by its centre, um.
inline LabelImage make_image(const Voxel& size, const Vec3& voxel,
                             const std::function<Label(const Vec3&)>& label) {
  LabelImage image;
  image.size = size;
  image.voxel = voxel;
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x) image.label.push_back(label(image.center({x, y, z})));
  return image;
}

}  // namespace acinus::image
