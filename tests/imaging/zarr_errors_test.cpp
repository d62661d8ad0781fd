/// OME-Zarr with metadata that are wrong, unknown or contradictory, and damaged chunks: errors that
/// name file, place, value and what is allowed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "imaging/import_image.hpp"
#include "imaging/write_image.hpp"
#include "imaging/zarr_codecs.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/images.hpp"
#include "tests/imaging/labelled_balls.hpp"
#include "tests/imaging/zarr_folder.hpp"

namespace acinus::imaging {
namespace {

namespace fs = std::filesystem;
using geometry::TempFolder;

std::string content(const std::string& path) {
  std::stringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

class ZarrErrors : public testing::Test {
 protected:
  /// Refusal after a text in a file of metadata is replaced.
  std::string changed(const ZarrForm& form, const std::string& file, const std::string& from,
                      const std::string& to) {
    write_zarr(path(), image_, form);
    std::string text = content(path() + file);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << file << ": " << from;
    zarr::write_file(path() + file, text.replace(at, from.size(), to));
    return refusal(path());
  }
  std::string path() const { return folder_.path() + "/a.zarr"; }

  TempFolder folder_;
  LabelImage image_ = [] {
    Label next = 0;
    return make_image({6, 5, 7}, {1, 1, 2}, [&](const Vec3&) { return next++ / 9 * 40; });
  }();
  ZarrForm third_{}, second_{.version = 2, .codec = "zlib"};
};

TEST_F(ZarrErrors, NameTheCodecsThatAreNotRead) {
  EXPECT_CONTAINS(
      changed(second_, "/0/.zarray", R"("id": "zlib")", R"("id": "lzma")"),
      "0/.zarray: /compressor/id = \"lzma\": gzip, zlib, zstd, blosc and crc32c are read");
  EXPECT_CONTAINS(
      changed(second_, "/0/.zarray", R"("filters": null)", R"("filters": [{"id": "delta"}])"),
      "/filters/0/id = \"delta\": filters are not read");
  ZarrForm form{.codec = "zstd"};
  EXPECT_CONTAINS(changed(form, "/0/zarr.json", R"("name": "zstd")", R"("name": "pcodec")"),
                  "0/zarr.json: /codecs/1/name = \"pcodec\": gzip");
  EXPECT_CONTAINS(changed(form, "/0/zarr.json", R"("name": "bytes")", R"("name": "vlen")"),
                  "/codecs/0/name = \"vlen\"");
  form = {.chunk = {6, 4, 4}, .inner = {3, 2, 2}, .codec = "zstd"};
  EXPECT_CONTAINS(changed(form, "/0/zarr.json", R"("codecs": [{"name": "bytes")",
                          R"("codecs": [{"name": "sharding_indexed")"),
                  "Write the image with one level of shards");
  EXPECT_CONTAINS(changed(form, "/0/zarr.json", "[3, 2, 2]", "[3, 3, 2]"),
                  "shards of 4 along axis 1 do not hold whole chunks of 3");
}

TEST_F(ZarrErrors, NameTheAxesThatAreWrong) {
  const auto axes = [&](const std::string& from, const std::string& to) {
    return changed(third_, "/zarr.json", from, to);
  };
  EXPECT_CONTAINS(axes(R"("name": "z")", R"("name": "q")"), "axis 0 is \"q\" (length 7)");
  EXPECT_CONTAINS(axes(R"("name": "z")", R"("name": "x")"), "axis 2 is \"x\" (length 6)");
  EXPECT_CONTAINS(axes(R"("type": "space")", R"("type": "time")"), "no axis z");
  EXPECT_CONTAINS(axes(R"({"name": "z", "type": "space", "unit": "micrometer"}, )", ""),
                  "/scale = [2,1,1]: 2 numbers are needed, one an axis");
  EXPECT_CONTAINS(
      axes(R"({"name": "z", "type": "space", "unit": "micrometer"})", R"("z")"),
      "/attributes/ome/multiscales/0/axes/0 = \"z\": an axis of OME-Zarr 0.4 is an object");
  EXPECT_CONTAINS(axes(R"("axes")", R"("sticks")"), "names no axes, as before version 0.4");
  EXPECT_CONTAINS(axes("0.5", "0.6"),
                  "version = \"0.6\": versions 0.4 and 0.5 of OME-Zarr are read");
  EXPECT_CONTAINS(
      axes(R"("unit": "micrometer")", R"("unit": "parsec")"),
      "the unit of axis z is \"parsec\", which is no length that is known. Give --voxel");
  EXPECT_CONTAINS(changed(third_, "/0/zarr.json", R"("attributes")",
                          R"("dimension_names": ["x", "y", "z"], "attributes")"),
                  "the dimension_names of ... differ");
}

TEST_F(ZarrErrors, NameTheScalesThatAreMissingOrWrong) {
  const auto scale = [&](const std::string& from, const std::string& to) {
    return changed(third_, "/zarr.json", from, to);
  };
  EXPECT_CONTAINS(scale("coordinateTransformations", "coordinates"),
                  "level 0 (\"0\") has no scale among its coordinateTransformations. Give --voxel");
  EXPECT_CONTAINS(scale("[2, 1, 1]", "[2, 1]"),
                  "/scale = [2,1]: 3 numbers are needed, one an axis");
  EXPECT_CONTAINS(scale("[2, 1, 1]", "[2, 0, 1]"), "numbers above 0 are needed");
  EXPECT_CONTAINS(scale(R"("type": "scale")", R"("type": "affine")"),
                  "/type = \"affine\": scale and translation are read");
  EXPECT_CONTAINS(scale(R"("path": "0")", R"("path": "7")"),
                  "a.zarr/7: holds neither zarr.json nor .zarray");
}

TEST_F(ZarrErrors, NameWhatIsWrongInMetadata) {
  const auto third = [&](const std::string& from, const std::string& to) {
    return changed(third_, "/0/zarr.json", from, to);
  };
  EXPECT_CONTAINS(third("{\"zarr", "\"zarr"), "a.zarr/0/zarr.json: no JSON from byte");
  EXPECT_CONTAINS(third("{\"zarr", "[{\"zarr"), "no JSON");
  EXPECT_CONTAINS(third("[7, 5, 6]", "[7, 5, 6e999]"), "a number beyond all bounds");
  EXPECT_CONTAINS(third("\"uint16\"", "\"complex64\""),
                  "/data_type = \"complex64\": uint8 to uint64");
  EXPECT_CONTAINS(third("[7, 5, 6]", "[7, 5, -6]"),
                  "/shape/2 = -6: a whole number from 0 on is needed");
  EXPECT_CONTAINS(third("[7, 5, 6]", "[7, 5]"), "shape has 2 axes, its chunks 3");
  EXPECT_CONTAINS(third("[7, 5, 6]", "[7, 5, 1000000000]"), "at most");
  EXPECT_CONTAINS(third("[3, 2, 4]", "[3, 2, 4000000000]"), "smaller chunks");
  EXPECT_CONTAINS(third("regular", "rectilinear"), "a regular grid of chunks is needed");
  EXPECT_CONTAINS(third("\"little\"", "\"middle\""),
                  "/endian = \"middle\": little or big is needed");
  EXPECT_CONTAINS(third("\"attributes\"", "\"secret\""), "/secret = ... is an extension of zarr");
  EXPECT_CONTAINS(third("\"shape\"", "\"form\""), "extension of zarr");
  const auto second = [&](const std::string& from, const std::string& to) {
    return changed(second_, "/0/.zarray", from, to);
  };
  EXPECT_CONTAINS(second("<u2", "<c8"), "/dtype = \"<c8\": numbers are |u1");
  EXPECT_CONTAINS(second("\"C\"", "\"X\""), "/order = \"X\": C or F is needed");
  EXPECT_CONTAINS(second(R"(separator": "/")", R"(separator": "-")"), "\".\" or \"/\" is needed");
  EXPECT_CONTAINS(second("\"shape\"", "\"form\""), "/shape is missing");
}

TEST_F(ZarrErrors, NameTheChunkThatIsDamaged) {
  for (const std::string codec : {"", "gzip", "zstd", "blosc", "gzip+sum"}) {
    write_zarr(path(), image_, {.codec = codec});
    const std::string file = path() + "/0/c/1/1/1";
    const std::string whole = content(file);
    zarr::write_file(file, whole.substr(0, whole.size() - 3));
    EXPECT_CONTAINS(refusal(path()), "0/c/1/1/1: ... truncated") << codec;
    zarr::write_file(file, "");
    EXPECT_CONTAINS(refusal(path()), "0/c/1/1/1: ... truncated") << codec;
  }
  write_zarr(path(), image_, {.codec = "+sum"});
  std::string bytes = content(path() + "/0/c/0/0/0");
  bytes[5] ^= 4;
  zarr::write_file(path() + "/0/c/0/0/0", bytes);
  EXPECT_CONTAINS(refusal(path()), "0/c/0/0/0: checksum ... is stored");
  write_zarr(path(), image_, {.type = "float32"});
  zarr::write_file(path() + "/0/c/0/0/0", std::string(96, '\x41'));
  EXPECT_CONTAINS(refusal(path()), "0/c/0/0/0: voxel (0, 0, 0) holds 12.07");
  fs::remove(path() + "/0/c/0/0/0");
  fs::create_directories(path() + "/0/c/0/0/0");
  EXPECT_CONTAINS(refusal(path()), "0/c/0/0/0: is no file, where the metadata expect a chunk");
}

TEST_F(ZarrErrors, KnowsTheChecksumOfTheStandard) {  // RFC 3720, B.4, and the usual check value
  EXPECT_EQ(crc32c("123456789"), 0xe3069283u);
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8a9136aau);
}

/// Every file of an image, cut and with bits changed: refused with a message, or read whole.
TEST_F(ZarrErrors, DamagedFilesAreRefusedOrRead) {
  std::mt19937 random(5);
  int refused = 0, read = 0;
  const auto attempt = [&] {
    try {
      const LabelImage found = read_labels(path(), {});
      EXPECT_EQ(found.label.size(),
                static_cast<std::size_t>(found.size[0]) * found.size[1] * found.size[2]);
      ++read;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
      ++refused;
    }
  };
  const std::vector<ZarrForm> forms{{.version = 2, .codec = "blosc"},
                                    {.version = 2, .codec = "zlib"},
                                    {.codec = "zstd"},
                                    {.codec = "gzip+sum"},
                                    {.chunk = {6, 4, 4}, .inner = {3, 2, 2}, .codec = "blosc"}};
  for (const ZarrForm& form : forms) {
    write_zarr(path(), image_, form);
    std::vector<std::string> files;
    for (const auto& e : fs::recursive_directory_iterator(path()))
      if (e.is_regular_file()) files.push_back(e.path().string());
    std::ranges::sort(files);
    for (const std::string& file : files) {
      const std::string whole = content(file);
      const bool metadata = file.ends_with("json") || file.find("/.z") != file.npos;
      for (int k = 0; k < (metadata ? 90 : 6); ++k) {
        std::string bytes = whole;
        if (k % 3 == 0)
          bytes.resize(random() % whole.size());
        else
          bytes[random() % whole.size()] ^= static_cast<char>(1 << random() % 8);
        zarr::write_file(file, bytes);
        attempt();
      }
      zarr::write_file(file, whole);
    }
    EXPECT_EQ(read_labels(path(), {}).label, image_.label);
  }
  fmt::print("{} refused, {} read\n", refused, read);
  EXPECT_GT(refused, 300);
}

TEST_F(ZarrErrors, CellsAreThoseOfTheSameLabelsInTiff) {
  const LabelImage balls = imaging::balls(kTwoBalls);
  const std::string tiff = folder_.path() + "/balls.tif";
  write_image(tiff, balls);
  ImportOptions o;
  o.image = tiff;
  const ImportedTissue expected = import_image(o);
  for (const int version : {2, 3}) {
    write_zarr(path(), balls, {.version = version, .chunk = {16, 16, 16}, .codec = "zstd"});
    o.image = path();
    const ImportedTissue found = import_image(o);
    ASSERT_EQ(found.cell.size(), expected.cell.size());
    for (std::size_t k = 0; k < found.cell.size(); ++k) {
      EXPECT_NEAR(found.cell[k].volume, expected.cell[k].volume, 1e-6 * expected.cell[k].volume);
      EXPECT_NEAR((found.cell[k].center - expected.cell[k].center).norm(), 0, 1e-6);
      EXPECT_EQ(found.cell[k].surface.triangle, expected.cell[k].surface.triangle);
    }
  }
}

}  // namespace
}  // namespace acinus::imaging
