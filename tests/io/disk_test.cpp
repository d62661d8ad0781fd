#include "io/disk.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>

#include "core/error.hpp"
#include "tests/io/sample.hpp"

namespace acinus::io {
namespace {

namespace fs = std::filesystem;

TEST(Disk, TextReplacesAFile) {
  write_text_file(test::path("text"), "long before");
  write_text_file(test::path("text"), "after");
  EXPECT_EQ(read_text_file(test::path("text")), "after");
  EXPECT_FALSE(fs::exists(test::path("text") + ".tmp"));
}

TEST(Disk, PipesAndDevicesGetTheTextAndStay) {
  const std::string pipe = test::path("pipe"), text(200'000, 'x');
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  {
    const std::jthread reader([&] { read = read_text_file(pipe); });
    write_text_file(pipe, text);
  }
  EXPECT_TRUE(read == text);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_FALSE(fs::exists(pipe + ".tmp"));
  fs::remove(pipe);
  // Not the devices themselves: a fault here would take them from the machine.
  for (const auto& [device, minor] : {std::pair{"null", 3}, {"full", 7}}) {
    const std::string node = test::path(device);
    if (mknod(node.c_str(), S_IFCHR | 0600, makedev(1, minor)) != 0) GTEST_SKIP();
    if (minor == 3)
      write_text_file(node, text);
    else
      EXPECT_THROW(write_text_file(node, text), Error);
    EXPECT_TRUE(fs::is_character_file(node)) << device;
    fs::remove(node);
  }
}

}  // namespace
}  // namespace acinus::io
