#include "core/io/file_lock.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <utility>

namespace acinus::io {
namespace {

std::string path(const char* name) { return testing::TempDir() + name + std::to_string(getpid()); }

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

TEST(FileLock, SaysWhoHoldsIt) {
  const std::string file = path("named");
  const std::string me = "process " + std::to_string(getpid()) + " on ";
  std::ofstream(file) << "process 1 on elsewhere since long ago, and the rest of a longer line\n";
  const FileLock held = FileLock::take(file);
  EXPECT_TRUE(name_holder(file).starts_with(me)) << name_holder(file);
  EXPECT_EQ(name_holder(path("none")), "another process");
}

TEST(FileLock, MovesWithItsOwner) {
  const std::string file = path("moved");
  FileLock a = FileLock::take(file);
  const FileLock b = std::move(a);
  EXPECT_TRUE(is_locked(file));
}

}  // namespace
}  // namespace acinus::io
