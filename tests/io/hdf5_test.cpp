#include "io/hdf5.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::io::h5 {
namespace {

using test::Folder;

TEST(Hdf5, SessionWithoutCloseLeavesEveryByte) {
  const Folder folder("hdf5_discard");
  const std::string path = folder / "a.h5";
  std::vector<double> value(3000, 1.5);
  {
    File file = File::create(path, Format::kEarliest);
    file.create_rows<double>("/a", {.chunk_rows = 64, .filtered = true}, "um");
    file.write_rows<double>("/a", 0, value);
    file.close();
  }
  const std::string before = read_text_file(path);
  {
    File file = File::open(path, Access::kAppend);
    file.write_rows<double>("/a", 3000, value);
    file.create_rows<float>("/b", {.components = 3}, "nN");
    file.write_attribute("/a", "unit", "nm");
  }
  EXPECT_TRUE(read_text_file(path) == before);
  {
    File file = File::open(path, Access::kAppend);
    file.write_rows<double>("/a", 3000, value);
    file.flush();
    file.write_rows<double>("/a", 6000, value);  // the second session is lost, the first is kept
  }
  EXPECT_EQ(File::open(path, Access::kRead).n_row("/a"), 6000);
  EXPECT_EQ(File::open(path, Access::kRead).read_all<double>("/a"), std::vector<double>(6000, 1.5));
}

TEST(Hdf5, ReadsBackWhatWasWrittenWithinASession) {
  const Folder folder("hdf5_overlay");
  const std::string path = folder / "a.h5";
  {
    File file = File::create(path, Format::kEarliest);
    file.create_rows<std::int64_t>("/a", {.chunk_rows = 100}, "1");
    file.create_rows<float>("/p", {.components = 3, .chunk_rows = 10}, "um");
    file.close();
  }
  File file = File::open(path, Access::kAppend);
  for (std::int64_t i = 0; i < 1000; ++i) file.write_row<std::int64_t>("/a", i, i * i);
  const std::vector<float> point{1, 2, 3, 4, 5, 6};
  file.write_rows<float>("/p", 5, point);
  file.flush();
  EXPECT_EQ(file.read_rows<std::int64_t>("/a", 999, 1).at(0), 999 * 999);
  EXPECT_EQ(file.read_rows<float>("/p", 5, 2), point);
  EXPECT_EQ(file.read_rows<float>("/p", 4, 1), std::vector<float>(3, 0));
  EXPECT_EQ(file.components("/p"), 3);
  EXPECT_EQ(file.components("/a"), 0);
  file.close();
}

TEST(Hdf5, TextAndAttributes) {
  const Folder folder("hdf5_text");
  File file = File::create(folder / "a.h5", Format::kChecked);
  file.create_group("/g");
  file.write_text("/g/long", std::string(200000, 'y'));
  file.write_text("/g/empty", "");
  file.write_text("/g/empty", "now longer");
  file.create_text_rows("/g/rows", 8, 16);
  const std::vector<std::string> rows{"", "12345678", "123456789"};
  file.write_text_rows("/g/rows", 0, rows);
  file.write_attribute("/g", "name", "first");
  file.write_attribute("/g", "name", "a longer second");
  file.write_hash("/g", "hash", ~std::uint64_t{0});
  file.close();
  const File back = File::open(folder / "a.h5", Access::kRead);
  EXPECT_EQ(back.read_text("/g/long").size(), 200000U);
  EXPECT_EQ(back.read_text("/g/empty"), "now longer");
  EXPECT_EQ(back.read_text_rows("/g/rows", 0, 3),
            (std::vector<std::string>{"", "12345678", "12345..."}));
  EXPECT_EQ(back.read_text_attribute("/g", "name"), "a longer second");
  EXPECT_EQ(back.read_hash("/g", "hash"), ~std::uint64_t{0});
  EXPECT_EQ(back.members("/g"), (std::vector<std::string>{"empty", "long", "rows"}));
  EXPECT_TRUE(back.exists("/g/rows"));
  EXPECT_FALSE(back.exists("/none/rows"));
}

TEST(Hdf5, ErrorsNameFileAttemptAndReason) {
  const Folder folder("hdf5_error");
  const auto message = [](const auto& action) {
    return acinus::test::message_of(action, Exit::kFileError);
  };
  EXPECT_EQ(message([&] { File::open(folder / "x.h5", Access::kRead); }),
            folder /
                "x.h5: cannot open for reading: No such file or directory. "
                "Check the path: the folder or file does not exist.");
  File file = File::create(folder / "a.h5", Format::kEarliest);
  file.create_rows<double>("/a", {}, "um");
  EXPECT_CONTAINS(message([&] { file.read_all<float>("/a"); }), "unexpected type");
  EXPECT_CONTAINS(message([&] { file.read_rows<double>("/a", 5, 2); }), "rows up to 7");
  EXPECT_CONTAINS(message([&] { file.n_row("/b"); }), "cannot open dataset /b");
  EXPECT_CONTAINS(message([&] { File::create(folder.path, Format::kEarliest); }), "Is a directory");
}

}  // namespace
}  // namespace acinus::io::h5
