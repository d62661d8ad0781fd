/// Statements of image files about axes, sizes, units and numbers: each is followed, or
/// contradicted aloud by an error or a note.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "imaging/inflate.hpp"
#include "imaging/read_image.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/images.hpp"
#include "tests/imaging/tiff_bytes.hpp"

namespace acinus::imaging {
namespace {

using geometry::TempFolder;

LabelImage sample(const Voxel& size = {5, 4, 3}) {
  Label next = 0;
  return make_image(size, {1, 1, 2}, [&](const Vec3&) { return 300 * next++; });
}

class Statements : public testing::Test {
 protected:
  /// Writes a file and reads it.
  LabelImage read(const std::string& name, const std::string& bytes, const ReadImage& how = {}) {
    notes_.clear();
    return read_labels(folder_.write(name, bytes), how, &notes_);
  }
  std::string refusal(const std::string& name, const std::string& bytes,
                      const ReadImage& how = {}) {
    return test::message_of([&] { read(name, bytes, how); });
  }
  void expect_sample(const LabelImage& found, const LabelImage& wanted) {
    EXPECT_EQ(found.size, wanted.size);
    EXPECT_LT((found.voxel - wanted.voxel).norm(), 1e-5) << found.voxel.transpose();
    EXPECT_EQ(found.label, wanted.label);
  }
  std::string notes() const {
    std::string all;
    for (const std::string& n : notes_) all += n + "\n";
    return all;
  }
  TempFolder folder_;
  std::vector<std::string> notes_;
};

const ReadImage kGiven{.voxel = Vec3(1, 1, 2)};

// ---- TIFF

std::string ome(const std::string& attributes, const std::string& inside = "",
                const std::string& prefix = "") {
  const std::string p = prefix.empty() ? "" : prefix + ":";
  return fmt::format(
      "<?xml version=\"1.0\"?><!-- <Pixels SizeZ=\"99\"> --><{0}OME xmlns{1}=\"x\"><{0}Image>"
      "<{0}Pixels Type=\"uint16\" SizeX=\"5\" SizeY=\"4\" {2}>{3}</{0}Pixels></{0}Image></{0}OME>",
      p, prefix.empty() ? "" : ":" + prefix, attributes, inside);
}
const std::string kOme =
    "DimensionOrder=\"XYZCT\" SizeZ=\"3\" SizeC=\"1\" SizeT=\"1\" PhysicalSizeX=\"1\" "
    "PhysicalSizeY=\"1000\" PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"2\" ";

TEST_F(Statements, OmeWithAPrefixAndCommentsIsXml) {
  const LabelImage image = sample();
  expect_sample(read("a.tif", tiff(image, {.description = ome(kOme)})), image);
  expect_sample(read("b.tif", tiff(image, {.description = ome(kOme, "", "ome")})), image);
  EXPECT_CONTAINS(refusal("c.tif", tiff(image, {.description = ome(kOme) + "</OME>x<"})),
                  "its OME description is no XML");
}

TEST_F(Statements, OmeSaysWhichPageIsWhichPlane) {
  const LabelImage image = sample();
  std::string planes;
  for (int z = 0; z < 3; ++z)
    planes += fmt::format("<TiffData FirstZ=\"{}\" IFD=\"{}\"/>", z, 2 - z);
  expect_sample(read("a.tif", tiff(image, {.description = ome(kOme, planes), .slices = {2, 1, 0}})),
                image);
  const auto with = [&](const std::string& data) {
    return refusal("b.tif", tiff(image, {.description = ome(kOme, data)}));
  };
  EXPECT_CONTAINS(with("<TiffData FirstZ=\"0\" IFD=\"0\"/><TiffData FirstZ=\"0\" IFD=\"1\"/>"),
                  "gives plane 0 the page 0 and the page 1");
  EXPECT_CONTAINS(with("<TiffData FirstZ=\"0\" IFD=\"0\"/><TiffData FirstZ=\"1\" IFD=\"0\"/>"),
                  "gives page 0 to two planes");
  EXPECT_CONTAINS(with("<TiffData IFD=\"0\" PlaneCount=\"2\"/>"), "slice 2 of channel 0 is in no");
  EXPECT_CONTAINS(with("<TiffData IFD=\"0\" PlaneCount=\"2\"><UUID FileName=\"b.tif\"/></TiffData>"
                       "<TiffData FirstZ=\"2\" IFD=\"0\"><UUID FileName=\"c.tif\"/></TiffData>"),
                  "slice 2 of channel 0 is in another file");
  EXPECT_CONTAINS(with("<TiffData FirstZ=\"7\"/>"), "speaks of the plane z 7");
}

TEST_F(Statements, OmeOrderOfChannelsAndSlices) {
  LabelImage image = sample({5, 4, 6});  // pages: z 0 c 0, z 0 c 1, z 1 c 0, ...
  const std::string both =
      ome("DimensionOrder=\"XYCZT\" SizeZ=\"3\" SizeC=\"2\" SizeT=\"1\" PhysicalSizeX=\"1\" "
          "PhysicalSizeY=\"1\" PhysicalSizeZ=\"2\"");
  EXPECT_CONTAINS(refusal("a.tif", tiff(image, {.description = both})), "--channel 0 to 1");
  const LabelImage one = read("a.tif", tiff(image, {.description = both}), {.channel = 1});
  ASSERT_EQ(one.size, (Voxel{5, 4, 3}));
  EXPECT_EQ(one.label[20], image.label[3 * 20]);
}

TEST_F(Statements, OmeSizesThatCannotBeAreNamed) {
  const LabelImage image = sample();
  const auto with = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return refusal("a.tif", tiff(image, {.description = text}));
  };
  EXPECT_CONTAINS(with(ome(kOme), "SizeZ=\"3\"", "SizeZ=\"0\""), "says SizeZ = \"0\"");
  EXPECT_CONTAINS(with(ome(kOme), "SizeC=\"1\"", "SizeC=\"-1\""), "says SizeC = \"-1\"");
  EXPECT_CONTAINS(with(ome(kOme), "SizeC=\"1\"", ""), "says SizeC = nothing");
  EXPECT_CONTAINS(with(ome(kOme), "SizeX=\"5\"", "SizeX=\"6\""), "its description says 6 x 4");
  EXPECT_CONTAINS(with(ome(kOme), "uint16", "uint8"), "numbers of 2 bytes, its description says 1");
  EXPECT_CONTAINS(with(ome(kOme), "XYZCT", "XYZCC"), "DimensionOrder = \"XYZCC\"");
  EXPECT_CONTAINS(with(ome(kOme), "\"nm\"", "\"pixel\""), "PhysicalSizeYUnit = \"pixel\"");
  EXPECT_CONTAINS(with(ome(kOme), "SizeZ=\"3\"", "SizeZ=\"4\""), "3 pages, but its description");
  // The advice works.
  std::string text = ome(kOme);
  text.replace(text.find("\"nm\""), 4, "\"pixel\"");
  expect_sample(read("b.tif", tiff(image, {.description = text}), kGiven), image);
}

TEST_F(Statements, ImageJHasAUnitForEveryAxis) {
  const LabelImage image = sample();
  const auto with = [&](const std::string& lines) {
    return tiff(image,
                {.description = "ImageJ=1.53t\nimages=3\nslices=3\n" + lines, .per_unit = 1});
  };
  expect_sample(read("a.tif", with("unit=micron\nzunit=nm\nspacing=2000\n")), image);
  expect_sample(read("a.tif", with("unit=nm\nyunit=um\nzunit=mm\nspacing=-0.002\n"),
                     {.voxel = Vec3(1, 1, 2)}),
                image);
  EXPECT_CONTAINS(notes(), "the file says voxels of 0.001 x 1 x 2 um; 1 x 1 x 2 um are taken");
  EXPECT_CONTAINS(refusal("a.tif", with("unit=micron\nzunit=slice\nspacing=2\n")),
                  "ImageJ says zunit=slice");
  EXPECT_CONTAINS(refusal("a.tif", with("unit=micron\nslices=x\nspacing=2\n")),
                  "slices=3 and slices=x");
  EXPECT_CONTAINS(refusal("a.tif", tiff(image, {.description = "ImageJ=1\nimages=3\nslices=0\n"})),
                  "slices=\"0\"");
}

TEST_F(Statements, TifffileSaysTheShapeOfAStack) {
  const LabelImage image = sample({5, 4, 6});
  const auto with = [&](const std::string& text) { return tiff(image, {.description = text}); };
  expect_sample(read("a.tif", with("{\"shape\": [6, 4, 5]}"), kGiven), image);
  const LabelImage one = read("a.tif", with("{\"shape\": [2, 3, 4, 5], \"axes\": \"CZYX\"}"),
                              {.channel = 1, .voxel = Vec3(1, 1, 2)});
  EXPECT_EQ(one.label[0], image.label[3 * 20]);
  EXPECT_CONTAINS(refusal("a.tif", with("{\"shape\": [2, 3, 4, 5]}"), kGiven),
                  "6 pages by the axes without names");
  EXPECT_CONTAINS(refusal("a.tif", with("{\"shape\": [9, 4, 5]}"), kGiven),
                  "6 pages, but its description speaks of 9");
  EXPECT_CONTAINS(refusal("a.tif", with("{\"shape\": [6, 8, 5]}"), kGiven), "says 5 x 8");
}

TEST_F(Statements, TagsOfTiffThatCannotBeFollowedAreNamed) {
  const LabelImage image = sample();
  const auto with = [&](std::uint16_t tag, std::uint32_t value) {
    return tiff(image, {.tags = {{tag, value}}});
  };
  EXPECT_CONTAINS(refusal("a.tif", with(32997, 12), kGiven), "12 slices in one page (ImageDepth)");
  EXPECT_CONTAINS(refusal("a.tif", with(259, 7), kGiven), "compressed with JPEG (Compression 7)");
  EXPECT_CONTAINS(refusal("a.tif", with(259, 34712), kGiven), "JPEG 2000");
  EXPECT_CONTAINS(refusal("a.tif", with(277, 3), kGiven), "SamplesPerPixel");
  EXPECT_CONTAINS(refusal("a.tif", with(339, 5), kGiven), "of the kind 5 (SampleFormat)");
  EXPECT_CONTAINS(refusal("a.tif", with(254, 1), kGiven), "(NewSubfileType 1)");
  expect_sample(read("a.tif", with(254, 2), kGiven), image);
  expect_sample(read("a.tif", with(274, 4), kGiven), image);
  EXPECT_CONTAINS(notes(), "Orientation 4");
  expect_sample(read("a.tif", with(262, 0), kGiven), image);
  EXPECT_CONTAINS(notes(), "0 is white");
}

// ---- NIfTI

TEST_F(Statements, NiftiSaysItsSizesTwice) {
  const LabelImage image = sample();
  std::string file = nifti(image, 3);
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(&file[at], &value, sizeof(value));
  };
  const auto affine = [&](std::array<float, 9> m) {
    put(254, std::int16_t{1});
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t k = 0; k < 3; ++k) put(280 + 16 * row + 4 * k, m[3 * row + k]);
  };
  affine({0, 1, 0, 1, 0, 0, 0, 0, -2});  // axes exchanged and turned: the same sizes
  expect_sample(read("a.nii", file), image);
  EXPECT_EQ(notes(), "");
  affine({-1, 0, 0, 0, 1, 0, 0, 0, 2});
  expect_sample(read("a.nii", file), image);
  EXPECT_CONTAINS(notes(), "the affine (sform) mirrors the image");
  affine({1, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_CONTAINS(refusal("a.nii", file),
                  "pixdim says voxels of 1 x 1 x 2, the affine (sform) 1 x 1 x 1");
  expect_sample(read("a.nii", file, kGiven), image);
  affine({1, 0.5, 0, 0, std::sqrt(0.75f), 0, 0, 0, 2});
  expect_sample(read("a.nii", file), image);
  EXPECT_CONTAINS(notes(), "not at right angles");
}

TEST_F(Statements, NiftiPlacesAndLengths) {
  const LabelImage image = sample();
  std::string file = nifti(image, 3);
  for (const float offset : {std::nanf(""), 1e30f, -1.f, 352.5f}) {
    std::memcpy(&file[108], &offset, 4);
    EXPECT_CONTAINS(refusal("a.nii", file), "(vox_offset)");
  }
  EXPECT_CONTAINS(refusal("b.nii", nifti(image, 3) + "more"), "where the header announces");
  std::string packed = deflate_bytes(nifti(image, 3), true);
  packed[packed.size() - 6] ^= 1;  // the check sum
  EXPECT_CONTAINS(refusal("c.nii.gz", packed), "damaged");
  EXPECT_CONTAINS(refusal("d.nii.gz", packed.substr(0, packed.size() - 8)), "damaged");
}

TEST_F(Statements, AUnitOrAVoxelOfTheUserCountsAndIsTold) {
  const LabelImage image = sample();
  expect_sample(
      read("a.nii",
           nifti(make_image(image.size, {0.2, 0.2, 0.4},
                            [next = 0](const Vec3&) mutable { return Label(300 * next++); }),
                 2),
           {.unit = 5}),
      image);
  EXPECT_CONTAINS(notes(), "the file says units of 1000 um; 5 um is taken, as --unit says");
  expect_sample(read("b.nii", nifti(image, 2), kGiven), image);
  EXPECT_CONTAINS(notes(), "the file says voxels of 1000 x 1000 x 2000 um; 1 x 1 x 2 um are taken");
  EXPECT_CONTAINS(refusal("c.nii", nifti(image, 2), {.voxel = Vec3(1, 1, 2), .unit = 1}),
                  "--unit has no effect beside --voxel");
  EXPECT_CONTAINS(refusal("c.nii", nifti(image, 3), {.dataset = "labels"}), "--dataset names");
  EXPECT_CONTAINS(refusal("c.nii", nifti(image, 3), {.channel = 1}),
                  "--channel 1: the image has 1");
  EXPECT_CONTAINS(refusal("c.mha", "NDims = 3\n", {.channel = 2}), "--channel 2: the image has 1");
  expect_sample(read("c.nii", nifti(image, 3), {.dataset = "x", .channel = 1, .second = true}),
                image);
}

// ---- MetaImage, NRRD

const std::string kMeta =
    "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_USHORT\nDistanceUnits = "
    "um\n";

TEST_F(Statements, FieldsOfMetaImages) {
  const LabelImage image = sample();
  const std::string data = "ElementDataFile = LOCAL\n" + image_bytes<std::uint16_t>(image);
  const std::string sized = kMeta + "ElementSpacing = 1 1 2\n";
  const auto with = [&](const std::string& line) { return sized + line + "\n" + data; };
  expect_sample(read("a.mha", "\xef\xbb\xbf" + sized + data), image);
  EXPECT_CONTAINS(refusal("a.mha", with("ElementSize = 2 2 2")),
                  "ElementSpacing says 1 1 2, ElementSize 2 2 2");
  EXPECT_CONTAINS(refusal("a.mha", with("BinaryData = False")), "BinaryData = False");
  EXPECT_CONTAINS(refusal("a.mha", with("ElementToIntensityFunctionSlope = 2")), "to be scaled");
  EXPECT_CONTAINS(refusal("a.mha", with("DimSize = 5 4 2")), "says DimSize twice");
  EXPECT_CONTAINS(refusal("a.mha", with("HeaderSize = 8")), "not for LOCAL");
  EXPECT_CONTAINS(refusal("a.mha", with("CompressedData = True\nCompressedDataSize = 99")),
                  "CompressedDataSize says 99 bytes, but there are 120");
  read("a.mha", with("TransformMatrix = 1 0 0 0 -1 0 0 0 1"));
  EXPECT_CONTAINS(notes(), "transformmatrix mirrors");
  folder_.write("raw", "12345678" + image_bytes<std::uint16_t>(image));
  const std::string apart = sized + "HeaderSize = -1\nElementDataFile = raw\n";
  expect_sample(read("b.mhd", apart), image);
  EXPECT_CONTAINS(notes(), "the first 8 bytes");
  folder_.write("raw", "1234" + image_bytes<std::uint16_t>(image) + "more");
  EXPECT_CONTAINS(refusal("b.mhd", sized + "HeaderSize = 4\nElementDataFile = raw\n"),
                  "124 bytes of data where");
}

const std::string kNrrd = "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 5 4 3\nendian: little\n";

TEST_F(Statements, FieldsOfNrrd) {
  const LabelImage image = sample();
  const std::string data = "\n" + image_bytes<std::uint16_t>(image);
  const auto with = [&](const std::string& lines) {
    return kNrrd + "encoding: raw\n" + lines + data;
  };
  expect_sample(read("a.nrrd", with("spacings: 1 1000 2\nunits: \"um\" \"nm\" \"micron\"\n")),
                image);
  EXPECT_CONTAINS(refusal("a.nrrd", with("spacings: 1 1 2\nunits: \"um\" \"um\" \"\"\n")),
                  "without a unit along every axis");
  EXPECT_CONTAINS(refusal("a.nrrd", with("spacings: 1 1 2\nunits: \"um\"\n")),
                  "units needs three texts");
  EXPECT_CONTAINS(refusal("a.nrrd", with("spacings: 1 1 2\nspace directions: (1,0,0) (0,1,0) "
                                         "(0,0,3)\nspace units: \"um\" \"um\" \"um\"\n")),
                  "spacings says 2 along axis 2, space directions 3");
  EXPECT_CONTAINS(refusal("a.nrrd", with("kinds: domain domain list\n")), "the kind \"list\"");
  EXPECT_CONTAINS(refusal("a.nrrd", with("sizes: 5 4 2\n")), "says sizes twice");
  EXPECT_CONTAINS(refusal("a.nrrd", with("byte skip: 2.5\n")), "byte skip is 2.5");
  std::string text = with("spacings: 1 1 2\nunits: \"um\" \"um\" \"um\"\n");
  text.replace(text.find("little"), 6, "middle");
  EXPECT_CONTAINS(refusal("a.nrrd", text), "endian is \"middle\"");
  text = with(
      "spacings: 1 1 2\nspace directions: (-1,0,0) (0,1,0) (0,0,2)\nspace units: \"um\" "
      "\"um\" \"um\"\naxis mins: 0 0 0\n");
  expect_sample(read("a.nrrd", text), image);
  EXPECT_CONTAINS(notes(), "space directions mirrors");
  EXPECT_CONTAINS(notes(), "axis mins");
  EXPECT_CONTAINS(refusal("a.nrrd", kNrrd + "encoding: text\n\n" + std::string(122, '1') + "\n"),
                  "It looks truncated");
  std::string labels;
  for (int k = 0; k < 61; ++k) labels += "7 ";
  EXPECT_CONTAINS(refusal("a.nrrd", kNrrd + "encoding: text\n\n" + labels),
                  "more than the 60 labels");
}

TEST_F(Statements, NrrdSkipsLinesBeforeAndBytesBehindDecompression) {
  const LabelImage image = sample();
  const std::string units = "spacings: 1 1 2\nunits: \"um\" \"um\" \"um\"\nencoding: gzip\n";
  folder_.write("data.gz",
                "a line\n" + deflate_bytes("12345678" + image_bytes<std::uint16_t>(image), true));
  expect_sample(read("a.nhdr", kNrrd + units + "line skip: 1\nbyte skip: 8\ndata file: data.gz\n"),
                image);
  EXPECT_CONTAINS(
      refusal("a.nhdr", kNrrd + units + "line skip: 1\nbyte skip: -1\ndata file: data.gz\n"),
      "byte skip: -1 needs data without compression");
  EXPECT_CONTAINS(
      refusal("a.nhdr", kNrrd + units + "line skip: 1\nbyte skip: 6\ndata file: data.gz\n"),
      "hold more bytes where 126 are announced");
  const std::string bytes = image_bytes<std::uint16_t>(image);
  expect_sample(read("b.nrrd", kNrrd + units + "\n" + deflate_bytes(bytes.substr(0, 60), true) +
                                   deflate_bytes(bytes.substr(60), true)),
                image);  // a gzip file of two members
  EXPECT_CONTAINS(refusal("b.nrrd", kNrrd + units + "\n" + deflate_bytes(bytes, true) + "junk"),
                  "end 4 bytes before the file");
}

TEST_F(Statements, ASliceIsNoStack) {
  const LabelImage flat = sample({5, 4, 1});
  EXPECT_CONTAINS(refusal("a.tif", tiff(flat)), "one slice");
  EXPECT_CONTAINS(refusal("a.nii", nifti(flat, 3)), "5 x 4 x 1 voxels: one slice");
  EXPECT_CONTAINS(refusal("a.mha",
                          "NDims = 3\nDimSize = 5 1 4\nElementType = MET_USHORT\n"
                          "ElementDataFile = LOCAL\n" +
                              image_bytes<std::uint16_t>(flat)),
                  "5 x 1 x 4 voxels: one slice");
}

}  // namespace
}  // namespace acinus::imaging
