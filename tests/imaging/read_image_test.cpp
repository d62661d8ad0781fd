#include "imaging/read_image.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstring>
#include <string>

#include "imaging/inflate.hpp"
#include "imaging/tiff_text.hpp"
#include "imaging/write_image.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/imaging/images.hpp"

namespace acinus::imaging {
namespace {

using geometry::TempFolder;

constexpr Voxel kSize{5, 4, 3};

/// Every voxel another label, with gaps.
LabelImage numbered(Label step) {
  Label next = 0;
  return make_image(kSize, {0.5, 0.25, 1.5}, [&](const Vec3&) { return step * next++; });
}

void expect_image(const LabelImage& found, const LabelImage& wanted) {
  EXPECT_EQ(found.size, wanted.size);
  EXPECT_LT((found.voxel - wanted.voxel).norm(), 1e-6) << found.voxel.transpose();
  EXPECT_EQ(found.label, wanted.label);
}

TEST(ReadImage, GivesBackWhatWasWritten) {
  const TempFolder folder;
  for (const Label step : {1u, 300u, 70000u})  // 8, 16, 32 bits
    for (const char* name : {"image.tif", "image.mha", "image.nrrd"}) {
      const LabelImage image = numbered(step);
      const std::string path = folder.path() + "/" + name;
      write_image(path, image);
      const LabelImage found = read_labels(path);
      expect_image(found, image);
      EXPECT_EQ(read_image(path, {}).most_label, step == 1     ? 255u
                                                 : step == 300 ? 65535u
                                                               : 4294967295u);
    }
}

TEST(ReadImage, ReadsMetaImagesOfOthers) {
  const TempFolder folder;
  const LabelImage image = numbered(300);
  folder.write("image.raw", "skip" + image_bytes<std::uint16_t>(image, true));
  const std::string header =
      "ObjectType = Image\nNDims = 3\nBinaryDataByteOrderMSB = True\nDimSize = 5 4 3\n"
      "ElementSpacing = 0.5 0.25 1.5\nHeaderSize = 4\nElementType = MET_USHORT\n"
      "ElementDataFile = image.raw\n";
  const std::string path = folder.write("image.mhd", header);
  const std::string message = refusal(path);
  EXPECT_CONTAINS(message, "without a unit");
  EXPECT_CONTAINS(message, "--unit");
  expect_image(read_labels(path, {.unit = 1}), image);
  EXPECT_NEAR(read_image(path, {.unit = 100}).voxel[2], 150, 1e-9);
  EXPECT_CONTAINS(
      refusal(folder.write("a.mhd", "ObjectType = Image\nNDims = 2\nElementDataFile = x\n")),
      "a.mhd:2: the image has \"2\" dimensions");
  EXPECT_CONTAINS(refusal(folder.write("b.mha", "hello\n")), "without \"=\"");
  EXPECT_CONTAINS(refusal(folder.write("c.mha", "NDims = 3\n")), "no ElementDataFile");
  EXPECT_CONTAINS(refusal(folder.write("d.mha",
                                       "NDims = 3\nDimSize = 5 4 3\nElementType = MET_UCHAR\n"
                                       "ElementDataFile = LOCAL\nabc")),
                  "3 bytes of data where 5 x 4 x 3 voxels");
  EXPECT_CONTAINS(refusal(folder.write("e.mha",
                                       "NDims = 3\nDimSize = 5 4 3\nElementType = RGB\n"
                                       "ElementDataFile = LOCAL\nabc")),
                  "the element type \"RGB\" is not read");
}

TEST(ReadImage, ReadsNrrdOfOthers) {
  const TempFolder folder;
  const LabelImage image = numbered(1);
  const std::string path = folder.write(
      "image.nrrd",
      "NRRD0005\n# by hand\nkey:=value\ntype: unsigned char\ndimension: 3\nsizes: 5 4 3\n"
      "space: left-posterior-superior\nspace directions: (0.0005,0,0) (0,0.00025,0) (0,0,0.0015)\n"
      "space units: \"mm\" \"mm\" \"mm\"\nencoding: gzip\n\n" +
          deflate_bytes(image_bytes<std::uint8_t>(image), true));
  expect_image(read_labels(path, {}), image);
  std::string text;
  for (const Label l : image.label) text += fmt::format("{} ", l);
  expect_image(
      read_labels(folder.write("text.nrrd",
                               "NRRD0004\ntype: short\ndimension: 3\nsizes: 5 4 3\nspacings: "
                               "0.5 0.25 1.5\nencoding: ascii\n\n" +
                                   text),
                  {.unit = 1}),
      image);
  folder.write("big.raw", image_bytes<std::int32_t>(image, true));
  expect_image(
      read_labels(folder.write("other.nhdr",
                               "NRRD0004\ntype: int\ndimension: 3\nsizes: 5 4 3\nspacings: "
                               "0.5 0.25 1.5\nunits: \"um\" \"um\" \"um\"\nendian: big\n"
                               "encoding: raw\ndata file: big.raw\n"),
                  {}),
      image);
  EXPECT_CONTAINS(refusal(folder.write("a.nrrd", "NRRD0004\ntype: uint8\ndimension: 4\n\n")),
                  "has \"4\" dimensions");
  EXPECT_CONTAINS(refusal(folder.write("b.nrrd", "PNG")), "does not begin with NRRD000");
}

TEST(ReadImage, ReadsNifti) {
  const TempFolder folder;
  const LabelImage image = numbered(300);
  expect_image(read_labels(folder.write("image.nii", nifti(image, 3)), {}), image);
  expect_image(read_labels(folder.write("image.nii.gz", deflate_bytes(nifti(image, 3), true)), {}),
               image);
  EXPECT_NEAR(
      read_image(folder.write("mm.nii", nifti(image, 2)), {.voxel = Vec3(1, 2, 3)}).voxel[1], 2,
      1e-12);
  EXPECT_CONTAINS(refusal(folder.write("none.nii", nifti(image, 0))), "without a unit");
  EXPECT_CONTAINS(refusal(folder.write("slope.nii", nifti(image, 3, 2))), "scaled by 2");
  EXPECT_CONTAINS(refusal(folder.write("short.nii", nifti(image, 3).substr(0, 400))), "truncated");
  EXPECT_CONTAINS(refusal(folder.write("bad.nii", "nothing")), "is no NIfTI image");
}

/// Writes labels as [z][y][x] into a new dataset.
void write_hdf5(const std::string& path, const char* name, const LabelImage& image, bool sized,
                bool fresh) {
  const hid_t file = fresh ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)
                           : H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t shape[4] = {1, static_cast<hsize_t>(image.size[2]),
                            static_cast<hsize_t>(image.size[1]),
                            static_cast<hsize_t>(image.size[0])};
  const hid_t space = H5Screate_simple(4, shape, nullptr);
  const hid_t set =
      H5Dcreate2(file, name, H5T_STD_U16BE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, image.label.data());
  if (sized) {
    const hsize_t three = 3;
    const double step[3] = {image.voxel[2], image.voxel[1], image.voxel[0]};
    const hid_t line = H5Screate_simple(1, &three, nullptr);
    const hid_t attribute =
        H5Acreate2(set, "element_size_um", H5T_NATIVE_DOUBLE, line, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, step);
    H5Aclose(attribute);
    H5Sclose(line);
  }
  H5Dclose(set);
  H5Sclose(space);
  H5Fclose(file);
}

TEST(ReadImage, ReadsHdf5) {
  const TempFolder folder;
  const LabelImage image = numbered(300);
  const std::string path = folder.path() + "/image.h5";
  write_hdf5(path, "labels", image, true, true);
  expect_image(read_labels(path, {}), image);
  write_hdf5(path, "other", image, false, false);
  EXPECT_CONTAINS(refusal(path), "--dataset one of /labels, /other");
  EXPECT_CONTAINS(refusal(path, {.dataset = "other"}), "--voxel");
  expect_image(read_labels(path, {.dataset = "other", .voxel = image.voxel}), image);
  EXPECT_CONTAINS(refusal(path, {.dataset = "no"}), "there are /labels, /other");
}

TEST(ReadImage, SaysWhichVoxelIsNoLabel) {
  const TempFolder folder;
  LabelImage image = numbered(1);
  const std::string header =
      "NDims = 3\nDimSize = 5 4 3\nElementSpacing = 1 1 1\nDistanceUnits = um\n";
  std::string bytes = image_bytes<float>(image);
  const float wrong = 2.5;
  std::memcpy(&bytes[4 * (20 + 5 + 3)], &wrong, 4);
  EXPECT_CONTAINS(refusal(folder.write("a.mha", header +
                                                    "ElementType = MET_FLOAT\nElementDataFile = "
                                                    "LOCAL\n" +
                                                    bytes)),
                  "voxel (3, 1, 1) holds 2.5; labels are whole numbers");
  for (std::size_t k = 56; k < 60; ++k) std::memcpy(&bytes[4 * k], &wrong, 4);
  EXPECT_CONTAINS(refusal(folder.write("a.mha", header +
                                                    "ElementType = MET_FLOAT\nElementDataFile = "
                                                    "LOCAL\n" +
                                                    bytes)),
                  "voxel (3, 1, 1) holds 2.5, and at least 4 more");
  bytes = image_bytes<std::int16_t>(image);
  bytes[1] = '\xff';
  EXPECT_CONTAINS(refusal(folder.write("b.mha", header +
                                                    "ElementType = MET_SHORT\nElementDataFile = "
                                                    "LOCAL\n" +
                                                    bytes)),
                  "voxel (0, 0, 0) holds -256");
}

TEST(ReadImage, RefusesWhatIsNoImage) {
  const TempFolder folder;
  EXPECT_CONTAINS(refusal(folder.write("a.png", "x")), "not \".png\"");
  EXPECT_CONTAINS(refusal(folder.path() + "/none.tif"), "no such file");
  EXPECT_CONTAINS(refusal(folder.write("a.tif", "II*")), "cannot be read as TIFF");
  const std::string size =
      "NDims = 3\nDimSize = 900000 900000 1\nElementType = MET_UCHAR\n"
      "ElementDataFile = LOCAL\n";
  EXPECT_CONTAINS(refusal(folder.write("a.mha", size)), "at most 2^33");
  const LabelImage image = numbered(1);
  write_image(folder.path() + "/b.tif", image);
  const std::string voxel = refusal(folder.path() + "/b.tif", {.voxel = Vec3(1, 1, 1e6)});
  EXPECT_CONTAINS(voxel, "from 0.001 to 1000 um is allowed");
}

TEST(TiffText, OfOmeSaysOrderAndSizes) {
  const TiffText t = read_tiff_text(
      "a.tif",
      R"(<?xml version="1.0"?><OME xmlns="x"><Image><Pixels ID="P" DimensionOrder="XYCZT" SizeC="2"
         SizeT="3" SizeX="5" SizeY="4" SizeZ="7" PhysicalSizeX="500" PhysicalSizeXUnit="nm"
         PhysicalSizeY="0.25" PhysicalSizeZ="1.5" PhysicalSizeZUnit="&#181;m" Type="uint16"/>
         </Image></OME>)");
  EXPECT_TRUE(t.is_ome);
  EXPECT_EQ(t.slices, 7);
  EXPECT_NEAR((t.step.cwiseProduct(t.unit) - Vec3(0.5, 0.25, 1.5)).norm(), 0, 1e-12);
  EXPECT_EQ(t.plane(3, 1), 1 + 2 * 3);           // channel 1 of time 0
  EXPECT_EQ(t.plane(3, 5), 1 + 2 * 3 + 14 * 2);  // channel 1 of time 2
  EXPECT_CONTAINS(test::message_of([] {
                    read_tiff_text("a.tif", "<OME><Image><Pixels SizeZ=\"x\"/></Image></OME>");
                  }),
                  "says SizeZ = \"x\"");
}

TEST(TiffText, OfImageJSaysSpacing) {
  const TiffText t = read_tiff_text(
      "a.tif",
      "ImageJ=1.53t\nimages=12\nchannels=2\nslices=6\nunit=micron\nspacing=2.5\nloop=false\n");
  EXPECT_TRUE(t.is_imagej);
  EXPECT_EQ(t.slices, 6);
  EXPECT_EQ(t.channels, 2);
  EXPECT_EQ(t.unit, Vec3(1, 1, 1));
  EXPECT_EQ(t.step[2], 2.5);
  EXPECT_EQ(t.plane(2, 1), 5);
}

}  // namespace
}  // namespace acinus::imaging
