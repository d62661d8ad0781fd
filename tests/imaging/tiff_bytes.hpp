#pragma once
/// TIFF stacks as bytes, with whatever tags a test needs.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/imaging/images.hpp"

namespace acinus::imaging {

struct TiffHow {
  std::string description{};                      ///< of the first page
  std::map<std::uint16_t, std::uint32_t> tags{};  ///< further ones, or others, of every page
  double per_unit = 0;                            ///< resolution along x and y; 0: none
  std::vector<int> slices{};                      ///< which, in the order of pages; empty: all
};

/// Classic TIFF of 16 bits a pixel: of every page its data, then its directory.
class TiffWriter {
 public:
  TiffWriter(const LabelImage& image, const TiffHow& how) : image_(image), how_(how) {}

  std::string run() {
    out_ = std::string("II*\0\0\0\0\0", 8);
    link_ = 4;
    std::vector<int> slices = how_.slices;
    for (int z = 0; how_.slices.empty() && z < image_.size[2]; ++z) slices.push_back(z);
    for (std::size_t k = 0; k < slices.size(); ++k) add_page(slices[k], k == 0);
    return out_;
  }

 private:
  static std::string bytes(std::uint64_t value, std::size_t n) {
    std::string text;
    for (std::size_t k = 0; k < n; ++k) text += static_cast<char>(value >> (8 * k) & 0xff);
    return text;
  }
  std::uint32_t append(const std::string& text) {
    if (out_.size() % 2 == 1) out_ += '\0';
    const auto at = static_cast<std::uint32_t>(out_.size());
    out_ += text;
    return at;
  }
  void add_page(int z, bool first) {
    const std::size_t n = static_cast<std::size_t>(image_.size[0]) * image_.size[1];
    LabelImage slice = image_;
    slice.label.assign(&image_.label[n * static_cast<std::size_t>(z)],
                       &image_.label[n * static_cast<std::size_t>(z)] + n);
    const std::string data = image_bytes<std::uint16_t>(slice);
    std::map<std::uint16_t, std::uint32_t> tag{{256, image_.size[0]},
                                               {257, image_.size[1]},
                                               {258, 16},
                                               {259, 1},
                                               {262, 1},
                                               {273, append(data)},
                                               {277, 1},
                                               {278, image_.size[1]},
                                               {279, static_cast<std::uint32_t>(data.size())}};
    for (const auto& [key, value] : how_.tags) tag[key] = value;
    if (first && !how_.description.empty()) tag[270] = append(how_.description + '\0');
    if (how_.per_unit > 0)
      tag[282] = tag[283] =
          append(bytes(static_cast<std::uint32_t>(1e4 * how_.per_unit), 4) + bytes(10000, 4));
    std::string directory = bytes(tag.size(), 2);
    for (const auto& [key, value] : tag) {
      const bool text = key == 270, ratio = key == 282 || key == 283;
      directory += bytes(key, 2) +
                   bytes(text    ? 2
                         : ratio ? 5
                                 : 4,
                         2) +
                   bytes(text ? how_.description.size() + 1 : 1, 4) + bytes(value, 4);
    }
    const std::uint32_t at = append(directory + bytes(0, 4));
    out_.replace(link_, 4, bytes(at, 4));
    link_ = out_.size() - 4;
  }

  const LabelImage& image_;
  const TiffHow& how_;
  std::string out_;
  std::size_t link_ = 0;  ///< byte of the number that says where the next page is
};

inline std::string tiff(const LabelImage& image, const TiffHow& how = {}) {
  return TiffWriter(image, how).run();
}

}  // namespace acinus::imaging
