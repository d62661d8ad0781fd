#include "io/file_lock.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/io/sample.hpp"

namespace acinus::io {
namespace {

TEST(FileLock, IsHeldByOne) {
  const std::string file = test::path("lock");
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
  const std::string file = test::path("named");
  const std::string me = "process " + std::to_string(getpid()) + " on ";
  std::ofstream(file) << "process 1 on elsewhere since long ago, and the rest of a longer line\n";
  const FileLock held = FileLock::take(file);
  EXPECT_TRUE(name_holder(file).starts_with(me)) << name_holder(file);
  EXPECT_EQ(name_holder(test::path("none")), "another process");
}

// Between taking a lock and signing it, the file holds nothing or what a killed process left.
TEST(FileLock, WaitsForTheHolderToSign) {
  const std::string file = test::path("unsigned");
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
  const std::string file = test::path("moved");
  FileLock a = FileLock::take(file);
  const FileLock b = std::move(a);
  EXPECT_TRUE(is_locked(file));
}

mode_t mode_of(const std::string& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 ? status.st_mode & 0777 : 0;
}

// A lock can be taken through a descriptor that only reads: to read it is to keep its owner out.
TEST(FileLock, IsForThoseWhoMayWriteInTheFolder) {
  const std::string folder = test::path("folder"), file = folder + "/lock";
  mkdir(folder.c_str(), 0700);
  const std::vector<std::pair<mode_t, mode_t>> cases{
      {0700, 0600}, {0755, 0600}, {0775, 0660}, {0770, 0660}, {0777, 0666}};
  for (const auto& [open, wanted] : cases) {
    ASSERT_EQ(chmod(folder.c_str(), open), 0);
    { const FileLock made = FileLock::take(file); }
    EXPECT_EQ(mode_of(file), wanted) << std::oct << open;
    ASSERT_EQ(chmod(file.c_str(), 0644), 0);  // as earlier versions left it
    const FileLock taken = FileLock::take(file);
    EXPECT_EQ(mode_of(file), wanted) << std::oct << open;
  }
}

// Those who may not open a lock see whether somebody holds it.
TEST(FileLock, IsSeenByReaders) {
  if (geteuid() != 0) GTEST_SKIP() << "takes an administrator's account";
  const std::string folder = test::path("seen"), file = folder + "/lock";
  mkdir(folder.c_str(), 0755);
  const auto as_nobody = [&] {
    const pid_t child = fork();
    if (child == 0) {
      constexpr uid_t kNobody = 65534;
      _exit(setresuid(kNobody, kNobody, kNobody) == 0 ? (is_locked(file) ? 1 : 0) : 2);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  };
  {
    const FileLock held = FileLock::take(file);
    EXPECT_EQ(as_nobody(), 1);
  }
  EXPECT_EQ(as_nobody(), 0);
}

}  // namespace
}  // namespace acinus::io
