/// Datasets and attributes that are not what a reader expects: refused before memory is made.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>

#include "core/error.hpp"
#include "io/hdf5.hpp"
#include "io/hdf5_form.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::io::h5 {
namespace {

using test::Folder;

Handle texts_of_variable_length() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  return type;
}

Handle shape_of(const std::vector<hsize_t>& extent) {
  return {extent.empty()
              ? H5Screate(H5S_SCALAR)
              : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
          H5Sclose};
}

/// File with one dataset /a and one attribute "a" of the root, neither of them written.
struct Odd {
  explicit Odd(const std::string& name, hid_t type, const Handle& space) : path(name) {
    File file = File::create(path, Format::kEarliest);
    const Handle attribute(H5Acreate2(file.id(), "a", type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    const Handle dataset(
        H5Dcreate2(file.id(), "/a", type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    EXPECT_TRUE(attribute.valid() && dataset.valid());
    file.close();
  }
  std::string path;
};

/// Expects that each way to read the file ends with an error of the file.
void expect_refused(const std::string& path,
                    const std::vector<std::function<void(const File&)>>& reads) {
  for (std::size_t k = 0; k < reads.size(); ++k) {
    const File file = File::open(path, Access::kRead);
    EXPECT_CONTAINS(acinus::test::message_of([&] { reads[k](file); }, Exit::kFileError), path)
        << "way " << k;
  }
}

const std::function<void(const File&)> kText = [](const File&f) { f.read_text("/a"); },
                                       kTexts = [](const File&f) { f.read_text_rows("/a", 0, 1); },
                                       kTextAttribute =
                                           [](const File&f) { f.read_text_attribute("/", "a"); },
                                       kIntegers = [](const File&f) { f.read_attribute("/", "a"); },
                                       kCount = [](const File&f) { f.read_count("/", "a"); },
                                       kHash = [](const File&f) { f.read_hash("/", "a"); },
                                       kNumbers = [](const File&f) { f.read_all<double>("/a"); };

TEST(Hdf5Hostile, RefusesSeveralTextsInPlaceOfOne) {
  const Folder folder("hdf5_texts");
  const Handle type = text_type(8, H5T_CSET_ASCII);
  for (const std::vector<hsize_t>& extent :
       {std::vector<hsize_t>{21}, {0}, {3, 7}, {2, 2, 2}, {1, 1 << 10}})
    expect_refused(Odd(folder / "a.h5", type.id(), shape_of(extent)).path,
                   {kText, kTextAttribute, kIntegers, kCount, kHash, kNumbers});
  expect_refused(Odd(folder / "a.h5", type.id(), shape_of({4, 9})).path, {kTexts});
}

TEST(Hdf5Hostile, RefusesTextsOfVariableLengthAndOtherTypes) {
  const Folder folder("hdf5_variable");
  const auto all = {kText, kTexts, kTextAttribute, kIntegers, kCount, kHash, kNumbers};
  expect_refused(Odd(folder / "a.h5", texts_of_variable_length().id(), shape_of({})).path, all);
  expect_refused(Odd(folder / "a.h5", texts_of_variable_length().id(), shape_of({5})).path, all);
  expect_refused(Odd(folder / "a.h5", H5T_STD_REF_OBJ, shape_of({})).path, all);
  const hsize_t three = 3;
  const Handle array(H5Tarray_create2(H5T_STD_I64LE, 1, &three), H5Tclose);
  expect_refused(Odd(folder / "a.h5", array.id(), shape_of({})).path, all);
  const Handle numbers(H5Tvlen_create(H5T_STD_I64LE), H5Tclose);
  expect_refused(Odd(folder / "a.h5", numbers.id(), shape_of({})).path, all);
  expect_refused(Odd(folder / "a.h5", H5T_IEEE_F64LE, Handle(H5Screate(H5S_NULL), H5Sclose)).path,
                 all);
}

TEST(Hdf5Hostile, RefusesTextsOfGigabytes) {
  const Folder folder("hdf5_long");
  const std::string path = folder / "a.h5";
  for (const std::size_t width : {std::size_t{3'000'000'000}, std::size_t{100'000'000}}) {
    const Handle type = text_type(width, H5T_CSET_ASCII);
    File file = File::create(path, Format::kEarliest);
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_fill_time(list.id(), H5D_FILL_TIME_NEVER);  // sparse
    {
      const Handle made(H5Dcreate2(file.id(), "/a", type.id(), shape_of({}).id(), H5P_DEFAULT,
                                   list.id(), H5P_DEFAULT),
                        H5Dclose);
    }
    file.close();
    expect_refused(path, {kText, kTexts});
  }
}

/// Chunks that were never written are filled in: 4 kB of file become as much as the shape says.
TEST(Hdf5Hostile, RefusesMoreThanIsStored) {
  const Folder folder("hdf5_sparse");
  const std::string path = folder / "a.h5";
  for (const bool packed : {false, true})
    for (const hsize_t rows : {hsize_t{700'000'000}, hsize_t{10'000'000}, hsize_t{1} << 60}) {
      File file = File::create(path, Format::kEarliest);
      const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      const hsize_t chunk = 1024;
      H5Pset_chunk(list.id(), 1, &chunk);
      if (packed) H5Pset_deflate(list.id(), 1);
      {
        const Handle made(H5Dcreate2(file.id(), "/a", H5T_IEEE_F64LE, shape_of({rows}).id(),
                                     H5P_DEFAULT, list.id(), H5P_DEFAULT),
                          H5Dclose);
      }
      file.close();
      expect_refused(path, {kNumbers});
    }
}

TEST(Hdf5Hostile, RefusesWhatStandsInOtherFiles) {
  const Folder folder("hdf5_elsewhere");
  const std::string path = folder / "a.h5", secret = folder / "secret";
  std::ofstream(secret) << std::string(4096, 's');
  {
    File file = File::create(path, Format::kEarliest);
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_external(list.id(), secret.c_str(), 0, 64);
    {
      const Handle made(H5Dcreate2(file.id(), "/a", H5T_IEEE_F64LE, shape_of({8}).id(), H5P_DEFAULT,
                                   list.id(), H5P_DEFAULT),
                        H5Dclose);
    }
    file.close();
  }
  expect_refused(path, {kNumbers});
  // Links to other files are not known at all.
  EXPECT_EQ(H5Lis_registered(H5L_TYPE_EXTERNAL), 0);
}

TEST(Hdf5Hostile, DoesNotWaitForAPipe) {
  const Folder folder("hdf5_pipe");
  const std::string path = folder / "a.h5";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_THROW(File::open(path, Access::kRead), Error);
}

/// Many names of one dataset must not multiply it.
TEST(Hdf5Hostile, CountsWhatAFileHandsOutInAll) {
  const Folder folder("hdf5_names");
  const std::string path = folder / "a.h5";
  const std::vector<double> value(10000, 1);
  {
    File file = File::create(path, Format::kEarliest);
    file.write_array<double>("/a", value);
    file.close();
  }
  const File file = File::open(path, Access::kRead);
  const auto read_often = [&] {
    for (int k = 0; k < 2000; ++k) file.read_all<double>("/a");
  };
  EXPECT_THROW(read_often(), Error);
}

}  // namespace
}  // namespace acinus::io::h5
