/// Datasets of other programs: axes by name, codecs, chunks that were never written.

#include "imaging/read_image.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/hdf5_dataset.hpp"

namespace acinus::imaging {
namespace {

using geometry::TempFolder;

std::string tags_of(const std::string& axes) {
  std::string text = "{\"axes\": [";
  for (const char c : axes)
    text += std::string(text.back() == '[' ? "" : ", ") + "{\"key\": \"" + c +
            "\", \"typeFlags\": 2, \"resolution\": 0, \"description\": \"\"}";
  return text + "]}";
}

/// Value x + 10 y + 100 z + 1000 c + 10000 t at every place, by a letter an axis.
std::vector<std::uint32_t> numbers(const std::string& axes, const std::vector<hsize_t>& shape) {
  std::vector<std::uint32_t> out;
  std::size_t n = 1;
  for (const hsize_t s : shape) n *= s;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t rest = k;
    std::uint32_t value = 0;
    for (std::size_t a = axes.size(); a-- > 0; rest /= shape[a]) {
      std::uint32_t weight = 1;
      for (const char c : std::string("xyzct"))
        if (c == axes[a])
          break;
        else
          weight *= 10;
      value += weight * static_cast<std::uint32_t>(rest % shape[a]);
    }
    out.push_back(value);
  }
  return out;
}

class ReadHdf5 : public testing::Test {
 protected:
  std::string path() const { return folder_.path() + "/a.h5"; }
  LabelImage read(const Hdf5Dataset& d, const ReadImage& how = {}) {
    write_dataset(path(), d);
    notes_.clear();
    return read_labels(path(), how, &notes_);
  }
  std::string refused(const Hdf5Dataset& d, const ReadImage& how = {}) {
    write_dataset(path(), d);
    return refusal(path(), how);
  }
  TempFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(ReadHdf5, TakesTheOrderOfAxesThatTheFileSays) {
  const ReadImage given{.voxel = Vec3(1, 1, 2)};
  const LabelImage usual = read({{2, 3, 4}, numbers("zyx", {2, 3, 4})}, given);
  for (const std::string axes : {"xyz", "zyx", "yxz", "xzy"}) {
    std::vector<hsize_t> shape;
    for (const char c : axes) shape.push_back(c == 'x' ? 4 : c == 'y' ? 3 : 2);
    const LabelImage image = read({shape, numbers(axes, shape), tags_of(axes)}, given);
    EXPECT_EQ(image.size, (Voxel{4, 3, 2}));
    EXPECT_EQ(image.label, usual.label) << axes;
    std::vector<std::string> labels;
    for (const char c : axes) labels.emplace_back(1, c);
    EXPECT_EQ(read({shape, numbers(axes, shape), "", labels}, given).label, usual.label) << axes;
  }
}

TEST_F(ReadHdf5, TakesTheSizesOfVoxelsByTheAxes) {
  const std::vector<hsize_t> shape{1, 4, 3, 2, 1};
  Hdf5Dataset d{shape, numbers("txyzc", shape), tags_of("txyzc"), {}, {0.5, 0.25, 2}};
  EXPECT_EQ(read(d).voxel, Vec3(0.5, 0.25, 2));
  d.step = {9, 0.5, 0.25, 2, 9};
  EXPECT_EQ(read(d).voxel, Vec3(0.5, 0.25, 2));
  d.step = {1, 2};
  EXPECT_CONTAINS(refused(d), "element_size_um has 2 numbers for 5 axes");
}

TEST_F(ReadHdf5, PicksAChannelOfATime) {
  const std::vector<hsize_t> shape{2, 2, 3, 4, 3};  // t z y x c
  const Hdf5Dataset d{shape, numbers("tzyxc", shape), tags_of("tzyxc"), {}, {2, 1, 1}};
  EXPECT_CONTAINS(refused(d), "has 6 channels or times");
  const LabelImage image = read(d, {.channel = 5});  // c 2, t 1
  EXPECT_EQ(image.label[image.index({3, 2, 1})], 3u + 20 + 100 + 2000 + 10000);
}

TEST_F(ReadHdf5, RefusesAxesThatContradict) {
  const std::vector<hsize_t> shape{2, 3, 4};
  Hdf5Dataset d{shape, numbers("zyx", shape), tags_of("zyx"), {"x", "y", "z"}};
  EXPECT_CONTAINS(refused(d), "axistags says the axes z, y, x, its labels x, y, z");
  EXPECT_CONTAINS(refused({shape, d.value, tags_of("zyyx")}), "has 3 axes, but names 4");
  EXPECT_CONTAINS(refused({shape, d.value, tags_of("zyy")}), "its axes are z, y, y");
  EXPECT_CONTAINS(refused({shape, d.value, tags_of("zyc")}), "one slice");
  EXPECT_CONTAINS(refused({shape, d.value, "{\"axes\": 3}"}), "axistags cannot be read");
  EXPECT_CONTAINS(refused({shape, d.value, std::string(60000, '[')}), "axistags cannot be read");
  EXPECT_CONTAINS(refused({{3, 4}, numbers("yx", {3, 4})}), "two axes, 4 x 3: one slice");
}

TEST_F(ReadHdf5, NamesCodecsThatItCannotUndo) {
  const std::vector<hsize_t> shape{2, 3, 4};
  Hdf5Dataset d{shape, numbers("zyx", shape), "", {}, {2, 1, 1}, {2, 3, 4}, kForeign};
  EXPECT_CONTAINS(refused(d), "/labels is compressed with lzf (filter 32000)");
  d.filter = H5Z_FILTER_SHUFFLE;
  EXPECT_EQ(read(d).label, d.value);
}

TEST_F(ReadHdf5, ReservesNothingForNumbersThatAreNotThere) {
  Hdf5Dataset d{{1000, 1000, 1000}, {}, "", {}, {1, 1, 1}, {100, 100, 100}, 0, false};
  EXPECT_CONTAINS(refused(d), "none were ever written");
  std::ofstream(path(), std::ios::binary) << "nothing";
  EXPECT_CONTAINS(refusal(path(), {}, Exit::kFileError), "is no HDF5 file");
  write_dataset(path(), {{2, 3, 4}, numbers("zyx", {2, 3, 4})});
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) - 8);
  EXPECT_CONTAINS(refusal(path(), {}, Exit::kFileError), "cut short");
}

}  // namespace
}  // namespace acinus::imaging
