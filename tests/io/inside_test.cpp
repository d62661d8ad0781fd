#include "io/inside.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/file_lock.hpp"
#include "tests/io/sample.hpp"

namespace acinus::io {
namespace {

namespace fs = std::filesystem;
using test::Folder;

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(Inside, ReadsFilesBelowAFolderThatMayBeALink) {
  const Folder folder("inside_reads");
  put(folder / "root/a/b.txt", "text");
  fs::create_directory_symlink(folder / "root", folder / "link");
  for (const char* root : {"root", "link"}) {
    EXPECT_EQ(read_text_inside(folder / root, "a/b.txt"), "text");
    EXPECT_EQ(size_inside(folder / root, "a/b.txt"), 4U);
    EXPECT_FALSE(is_file_inside(folder / root, "a"));
    EXPECT_FALSE(is_file_inside(folder / root, "none"));
    EXPECT_TRUE(is_folder_inside(folder / root, "a"));
    EXPECT_TRUE(is_folder_inside(folder / root, "none/yet"));
  }
  EXPECT_THROW(read_text_inside(folder / "root", "a/b.txt", 3), Error);
}

TEST(Inside, FollowsNoLinkAndStaysBelow) {
  const Folder folder("inside_links");
  put(folder / "secret.txt", "secret");
  put(folder / "outside/c.txt", "secret");
  put(folder / "root/own.txt", "own");
  fs::create_symlink(folder / "secret.txt", folder / "root/link.txt");
  fs::create_symlink("own.txt", folder / "root/near.txt");
  fs::create_directory_symlink(folder / "outside", folder / "root/folder");
  const std::string root = folder / "root";
  for (const std::string& path :
       {std::string("link.txt"), std::string("near.txt"), std::string("folder/c.txt"),
        std::string("../secret.txt"), std::string("a/../../secret.txt"), folder / "secret.txt",
        std::string(""), std::string("."), std::string("own.txt\0.svg", 12),
        std::string("/proc/self/root") + (folder / "secret.txt")}) {
    EXPECT_FALSE(is_file_inside(root, path)) << path;
    EXPECT_THROW(read_text_inside(root, path), Error) << path;
  }
  EXPECT_FALSE(is_folder_inside(root, "folder"));
  EXPECT_FALSE(is_folder_inside(root, "folder/below"));
}

TEST(Inside, DoesNotWaitForPipes) {
  const Folder folder("inside_pipe");
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(is_file_inside(folder.path, "pipe"));
  EXPECT_THROW(read_text_inside(folder.path, "pipe"), Error);
  EXPECT_THROW(read_text_beside(pipe), Error);
  EXPECT_FALSE(is_locked(pipe));
  EXPECT_EQ(name_holder(pipe), "another process");
}

TEST(Inside, WritersPutNoEndToWhatALinkLeadsTo) {
  const Folder folder("inside_write");
  const std::string own = folder / "own.txt";
  put(own, "mine");
  fs::create_symlink(own, folder / "run.lock");
  EXPECT_THROW(FileLock::try_take(folder / "run.lock"), Error);
  EXPECT_FALSE(is_locked(folder / "run.lock"));
  fs::create_symlink(own, folder / "summary.json.tmp");
  EXPECT_THROW(write_text_file(folder / "summary.json", "theirs"), Error);
  EXPECT_EQ(read_text_file(own), "mine");
}

}  // namespace
}  // namespace acinus::io
