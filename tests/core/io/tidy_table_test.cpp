#include "core/io/tidy_table.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include "core/io/disk.hpp"
#include "core/io/file_lock.hpp"
#include "core/io/hdf5.hpp"

namespace acinus::io {
namespace {

std::string path(const char* name) { return testing::TempDir() + name + std::to_string(getpid()); }

TEST(TidyTable, TheSameRowsMakeTheSameBytes) {
  const std::vector<TidyColumn> columns{
      {"run", "", std::vector<std::string>{"a/seed_1", "a,b \xC2\xB5"}},
      {"seed", "1", std::vector<std::int64_t>{1, 2}},
      {"value", "um", std::vector<double>{0.1, -2e-300}}};
  write_tidy_table(path("one"), columns);
  write_tidy_table(path("two"), columns);
  EXPECT_TRUE(read_text_file(path("one")) == read_text_file(path("two")));
  const h5::File file = h5::File::open(path("one"), h5::Access::kRead);
  EXPECT_EQ(file.read_all<double>("/value"), (std::vector<double>{0.1, -2e-300}));
  EXPECT_EQ(file.read_text_attribute("/value", "unit"), "um");
  EXPECT_EQ(file.read_text_rows("/run", 0, 2)[1], "a,b \xC2\xB5");
}

TEST(TidyTable, MayBeEmpty) {
  write_tidy_table(path("empty"), {{"run", "", std::vector<std::string>{}},
                                   {"value", "um", std::vector<double>{}}});
  EXPECT_EQ(h5::File::open(path("empty"), h5::Access::kRead).n_row("/value"), 0);
}

TEST(FileLock, IsHeldByOne) {
  const std::string file = path("lock");
  EXPECT_FALSE(is_locked(file)) << "no such file";
  {
    const auto held = FileLock::try_take(file);
    ASSERT_TRUE(held.has_value());
    EXPECT_TRUE(is_locked(file));
    EXPECT_FALSE(FileLock::try_take(file));
  }
  EXPECT_FALSE(is_locked(file));
  EXPECT_TRUE(FileLock::try_take(file).has_value());
}

TEST(FileLock, MovesWithItsOwner) {
  const std::string file = path("moved");
  FileLock a = FileLock::take(file);
  const FileLock b = std::move(a);
  EXPECT_TRUE(is_locked(file));
}

}  // namespace
}  // namespace acinus::io
