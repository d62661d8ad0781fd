#pragma once
/// Small label images for the tests of this folder.

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "imaging/label_rows.hpp"
#include "imaging/read_image.hpp"
#include "tests/geometry/temp_folder.hpp"

namespace acinus::imaging {

/// Label of every voxel by its centre, um.
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

/// Image with a number per voxel. Throws if a line is not complete.
inline LabelImage spread_rows(const LabelRows& rows) {
  LabelImage image{rows, {}};
  image.label.reserve(image.n_voxel());
  for (const LabelLine& line : rows.line) {
    check(!line.empty() && line.back().end == rows.size[0], "a line ends early");
    for (std::size_t k = 0; k < line.size(); ++k)
      image.label.insert(image.label.end(), line[k].end - first_of(line, k), line[k].label);
  }
  return image;
}

/// Labels of a file, a number per voxel.
inline LabelImage read_labels(const std::string& path, const ReadImage& how = {},
                              std::vector<std::string>* notes = nullptr) {
  return spread_rows(read_image(path, how, notes));
}

/// Labels as numbers of a type, one after another.
template <class T>
std::string image_bytes(const LabelImage& image, bool swap = false) {
  std::string out;
  for (const Label l : image.label) {
    const T value = static_cast<T>(l);
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &value, sizeof(T));
    if (swap) one.assign(one.rbegin(), one.rend());
    out += one;
  }
  return out;
}

/// Header of NIfTI-1 [nifti1.h], little-endian, with the data behind it.
inline std::string nifti(const LabelImage& image, std::int16_t units, float slope = 0) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&h[at], &value, sizeof(value)); };
  put(0, std::int32_t{348});
  put(40, std::int16_t{3});
  for (std::size_t k = 0; k < 3; ++k) {
    put(42 + 2 * k, static_cast<std::int16_t>(image.size[k]));
    put(80 + 4 * k, static_cast<float>(image.voxel[static_cast<int>(k)]));
  }
  for (std::size_t k = 3; k < 7; ++k) put(42 + 2 * k, std::int16_t{1});
  put(70, std::int16_t{512});  // uint16
  put(72, std::int16_t{16});
  put(108, 352.0f);
  put(112, slope);
  put(123, static_cast<char>(units));
  std::memcpy(&h[344], "n+1", 4);
  return h + image_bytes<std::uint16_t>(image);
}

/// Message with which an image is refused.
inline std::string refusal(const std::string& path, const ReadImage& how = {},
                           Exit code = Exit::kBadInput) {
  return test::message_of([&] { read_image(path, how); }, code);
}

}  // namespace acinus::imaging
