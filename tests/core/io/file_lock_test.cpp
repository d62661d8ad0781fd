#include "core/io/file_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>
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

// Between taking a lock and signing it, the file holds nothing or what a killed process left.
TEST(FileLock, WaitsForTheHolderToSign) {
  const std::string file = path("unsigned");
  const pid_t ended = fork();
  if (ended == 0) _exit(0);
  waitpid(ended, nullptr, 0);
  std::string line;
  {
    const FileLock held = FileLock::take(file);
    std::ifstream in(file);
    std::getline(in, line);
  }
  EXPECT_EQ(name_holder(file), "another process") << "let go";
  const std::string mine = std::to_string(getpid());
  const std::string stale =
      line.substr(0, 8) + std::to_string(ended) + line.substr(8 + mine.size());
  std::ofstream(file) << stale << "\n";
  EXPECT_EQ(name_holder(file), "another process") << stale;
  std::thread signs([&] {
    usleep(100000);
    std::ofstream(file) << line << "\n";
  });
  EXPECT_EQ(name_holder(file, 5), line);
  signs.join();
}

TEST(FileLock, MovesWithItsOwner) {
  const std::string file = path("moved");
  FileLock a = FileLock::take(file);
  const FileLock b = std::move(a);
  EXPECT_TRUE(is_locked(file));
}

}  // namespace
}  // namespace acinus::io
