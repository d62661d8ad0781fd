/// Folders of OME-Zarr as other programs write them: versions, codecs, orders, shards, levels.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/parallel/threads.hpp"
#include "imaging/read_image.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/images.hpp"
#include "tests/imaging/zarr_folder.hpp"

namespace acinus::imaging {
namespace {

using geometry::TempFolder;

LabelImage numbered() {
  Label next = 0;
  return make_image({6, 5, 7}, {1, 0.5, 2}, [&](const Vec3&) { return next++ / 9 * 3; });
}

class ReadZarr : public testing::Test {
 protected:
  LabelImage read(const ZarrForm& form, const ReadImage& how = {}) {
    write_zarr(path(), image_, form);
    notes_.clear();
    return read_labels(path(), how, &notes_);
  }
  std::string path() const { return folder_.path() + "/a.zarr"; }

  TempFolder folder_;
  LabelImage image_ = numbered();
  std::vector<std::string> notes_;
};

TEST_F(ReadZarr, ReadsEveryCodecOrderAndSeparator) {
  for (const int version : {2, 3})
    for (const std::string codec : {"", "gzip", "zlib", "zstd", "blosc"})
      for (const bool reversed : {false, true})
        for (const char separator : {'/', '.'}) {
          if (version == 3 && codec == "zlib") continue;
          const LabelImage found = read({.version = version,
                                         .codec = codec,
                                         .big = reversed,
                                         .reversed = reversed,
                                         .separator = separator});
          EXPECT_EQ(found.size, image_.size);
          EXPECT_EQ(found.voxel, image_.voxel);
          EXPECT_EQ(found.label, image_.label) << version << codec << reversed << separator;
          EXPECT_TRUE(notes_.empty());
        }
}

TEST_F(ReadZarr, ReadsEveryType) {
  for (const int version : {2, 3})
    for (const bool big : {false, true})
      for (const std::string type : {"uint8", "int8", "uint16", "int16", "uint32", "int32",
                                     "uint64", "int64", "float32", "float64"})
        EXPECT_EQ(read({.version = version, .type = type, .big = big}).label, image_.label)
            << version << type << big;
}

TEST_F(ReadZarr, ReadsAlikeWithAnyNumberOfThreads) {
  set_threads(3);
  EXPECT_EQ(read({.codec = "blosc"}).label, image_.label);
  EXPECT_EQ(read({.chunk = {6, 4, 4}, .inner = {3, 2, 4}}).label, image_.label);
  set_threads(1);
}

TEST_F(ReadZarr, ReadsShards) {
  for (const std::string codec : {"", "zstd", "blosc", "gzip+sum", "+sum"})
    for (const bool first : {false, true}) {
      const ZarrForm form{
          .chunk = {6, 4, 4}, .inner = {3, 2, 2}, .codec = codec, .index_first = first};
      EXPECT_EQ(read(form).label, image_.label) << codec << first;
    }
}

TEST_F(ReadZarr, TakesMissingChunksAsTheFillValue) {
  image_ = make_image({6, 5, 7}, {1, 1, 1}, [](const Vec3& x) { return x[2] > 3 ? 5u : 0u; });
  for (const int version : {2, 3}) {
    EXPECT_EQ(read({.version = version, .skip_zeros = true}).label, image_.label);
    const LabelImage found = read({.version = version, .fill = "9", .skip_zeros = true});
    EXPECT_EQ(found.label[0], 9u);
    EXPECT_EQ(found.label.back(), 5u);
    write_zarr(path(), image_, {.version = version, .fill = "-1", .skip_zeros = true});
    EXPECT_CONTAINS(refusal(path()),
                    "6 of its 18 chunks are not stored, and its fill value is no label");
  }
  image_.label.assign(image_.label.size(), 0);
  write_zarr(path(), image_, {.skip_zeros = true});
  EXPECT_CONTAINS(refusal(path()), "none of its chunks is there");
}

TEST_F(ReadZarr, TakesTheOrderOfAxesAndChannels) {
  for (const std::string axes : {"xyz", "yxz", "zxy", "tczyx", "xyzc", "tzyx"}) {
    ZarrForm form{.version = 2, .axes = axes, .length = {1, 1}};
    EXPECT_EQ(read(form).label, image_.label) << axes;
    EXPECT_EQ(read(form).voxel, image_.voxel) << axes;
  }
  const ZarrForm form{.axes = "tczyx", .length = {2, 3}};
  write_zarr(path(), image_, form);
  EXPECT_CONTAINS(refusal(path()), "has 6 channels or times. Say which ... --channel 0 to 5");
  const LabelImage found = read_labels(path(), {.channel = 5});  // c 2, t 1
  EXPECT_EQ(found.label.front(), image_.label.front() + 12000);
  EXPECT_EQ(found.label.back(), image_.label.back() + 12000);
}

TEST_F(ReadZarr, TakesScalesAndUnits) {
  ZarrForm form{.unit = "nanometer",
                .steps = "[200, 10, 5]",
                .image_steps = R"([{"type": "scale", "scale": [10, 20, 100]}])"};
  EXPECT_EQ(read(form).voxel, Vec3(0.5, 0.2, 2));
  form.image_steps =
      R"([{"type": "scale", "scale": [1, 1, 1]}, {"type": "translation", "translation": [0, 0, 99]}])";
  EXPECT_EQ(read(form).voxel, Vec3(0.005, 0.01, 0.2));
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_CONTAINS(notes_[0], "the translation of 99 x 0 x 0 is not applied");
  EXPECT_EQ(read(form, {.voxel = Vec3(1, 2, 3)}).voxel, Vec3(1, 2, 3));
  form.unit = "";
  write_zarr(path(), image_, form);
  EXPECT_CONTAINS(refusal(path()), "its voxels are 5 x 10 x 200, without a unit");
  EXPECT_EQ(read_labels(path(), {.unit = 0.1}).voxel, Vec3(0.5, 1, 20));
}

TEST_F(ReadZarr, ChoosesTheLevel) {
  const LabelImage coarse =
      make_image({3, 3, 4}, {2, 1, 4}, [](const Vec3& x) { return static_cast<Label>(x[0]); });
  for (const int version : {2, 3}) {
    std::filesystem::remove_all(path());
    const ZarrForm form{.version = version};
    write_group(
        path(), version,
        multiscales(form, {"fine", "coarse"}, {scale_of(image_, form), scale_of(coarse, form)}));
    zarr::Writer(image_, form).write(path() + "/fine");
    zarr::Writer(coarse, form).write(path() + "/coarse");
    EXPECT_EQ(read_labels(path(), {}).label, image_.label);
    const LabelImage found = read_labels(path(), {.level = 1});
    EXPECT_EQ(found.label, coarse.label);
    EXPECT_EQ(found.voxel, coarse.voxel);
    EXPECT_CONTAINS(refusal(path(), {.level = 2}), "--level 2: the image has 2 levels");
    EXPECT_CONTAINS(refusal(path() + "/fine"),
                    "is one array of zarr. Give the folder of the image");
  }
}

TEST_F(ReadZarr, ChoosesTheLabelImage) {
  for (const int version : {2, 3}) {
    std::filesystem::remove_all(path());
    const ZarrForm form{.version = version};
    write_zarr(path(), image_, form);  // the picture
    write_zarr(path() + "/labels/cells", image_, form);
    write_group(path() + "/labels", version, R"("labels": ["cells"])");
    EXPECT_EQ(read_labels(path(), {}).label, image_.label);
    EXPECT_EQ(read_labels(path() + "/", {}).label, image_.label);
    EXPECT_EQ(read_labels(path() + "/labels", {}).label, image_.label);
    EXPECT_EQ(read_labels(path() + "/labels/cells", {}).label, image_.label);
    LabelImage nuclei = image_;
    for (Label& l : nuclei.label) l += 1;
    write_zarr(path() + "/labels/nuclei", nuclei, form);
    write_group(path() + "/labels", version, R"("labels": ["cells", "nuclei"])");
    EXPECT_CONTAINS(refusal(path()),
                    "has 2 label images. Say which: --dataset one of cells, nuclei");
    EXPECT_EQ(read_labels(path(), {.dataset = "nuclei"}).label, nuclei.label);
    EXPECT_EQ(read_labels(path(), {.dataset = "labels/nuclei"}).label, nuclei.label);
    EXPECT_CONTAINS(refusal(path(), {.dataset = "tails"}),
                    "there is no such folder; its labels are cells, nuclei");
  }
}

TEST_F(ReadZarr, SaysWhatAFolderIsThatIsNoImage) {
  EXPECT_CONTAINS(refusal(folder_.path()), "holds no image of OME-Zarr: no \"multiscales\"");
  write_zarr(folder_.path() + "/a/0", image_, {});
  write_zarr(folder_.path() + "/a/1", image_, {});
  EXPECT_CONTAINS(refusal(folder_.path() + "/a"),
                  "holds several images: 0, 1. Give the folder of one");
  EXPECT_CONTAINS(refusal(folder_.path() + "/none.zarr"), "There is no such folder");
  EXPECT_CONTAINS(refusal(folder_.write("a.ozx", "PK")), "Unpack it");
  EXPECT_CONTAINS(refusal(folder_.write("a.tif", "II"), {.level = 1}),
                  "--level chooses a resolution of OME-Zarr");
}

TEST_F(ReadZarr, NotesPicturesThatMayBeNoLabels) {
  write_zarr(path(), image_, {});
  const std::string file = path() + "/zarr.json";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string without = text.str();
  without.replace(without.find("image-label"), 11, "image-other");
  zarr::write_file(file, without);
  read_labels(path(), {}, &notes_);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_CONTAINS(notes_[0], "do not say that this is a label image");
}

}  // namespace
}  // namespace acinus::imaging
