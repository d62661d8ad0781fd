/// Run files with damaged bytes: damage is found and reported, and readable frames are kept.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "io/disk.hpp"
#include "io/page_sums.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "tests/io/expect_frame.hpp"
#include "tests/io/sample.hpp"

namespace acinus::io {
namespace {

using test::Folder;
using test::make_frame;

constexpr int kFrames = 4;

Frame frame_of(int k) { return make_frame(k, 300, 100); }

std::string write_run(const Folder& folder) {
  const std::string path = folder / "run.vtkhdf";
  RunFile run = RunFile::create(path, {{"seed", "1"}, {"scene", "{}"}});
  for (int k = 0; k < kFrames; ++k) {
    const SeriesValue observed[] = {{"time", "s", 60.0 * k}, {"cells", "1", 900.0 + k}};
    run.append(frame_of(k), observed);
    const SeriesValue sample[] = {{"time", "s", 60.0 * k}, {"dt", "s", 10.0}};
    run.append_series(sample);
    run.append_event({60.0 * k, "note", {k}, "event"});
  }
  run.close();
  return path;
}

RunFileCounts all_of(const std::string& path) { return RunReader(path).counts(); }

void flip(const std::string& path, std::size_t at) {
  std::string bytes = read_text_file(path);
  bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
  write_text_file(path, bytes);
}

TEST(RunRecovery, NothingIsSaidOfAnIntactFile) {
  const Folder folder("recovery_intact");
  const std::string path = write_run(folder);
  EXPECT_FALSE(h5::is_damaged(path));
  const RunFile run = RunFile::open_for_append(path, all_of(path));
  EXPECT_TRUE(run.lost().empty());
  EXPECT_FALSE(h5::is_damaged(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".damaged"));
}

// Every kind of place: superblock, groups, indices, chunks, texts, tables.
TEST(RunRecovery, NoFlippedByteIsAccepted) {
  const Folder folder("recovery_flips");
  const std::string path = write_run(folder);
  const std::string whole = read_text_file(path), sums = read_text_file(h5::sums_of(path));
  const RunFileCounts counts = all_of(path);
  int lost_one = 0, lost_all = 0, tried = 0;
  for (std::size_t at = 3; at < whole.size(); at += whole.size() / 40 + 1, ++tried) {
    write_text_file(path, whole);
    write_text_file(h5::sums_of(path), sums);
    flip(path, at);
    RunFile run = RunFile::open_for_append(path, counts);
    EXPECT_FALSE(run.lost().empty()) << at;
    EXPECT_TRUE(std::filesystem::exists(path + ".damaged"));
    lost_one += run.n_frame() == kFrames - 1 ? 1 : 0;
    lost_all += run.n_frame() == 0 ? 1 : 0;
    run.append(frame_of(kFrames + 1));
    run.close();
    EXPECT_FALSE(h5::is_damaged(path)) << at;
    const RunReader reader(path);
    for (int k = 0; k < reader.n_frame(); ++k)
      test::expect_same_frame(reader.frame(k),
                              frame_of(static_cast<int>(reader.time_s(k) / 60 + 0.5)));
  }
  EXPECT_GT(tried, 30);
  EXPECT_GT(lost_one, 0) << "a chunk belongs to one frame";
  EXPECT_LT(lost_all, tried / 2);
  std::printf("%d flips: one frame lost by %d, all of them by %d\n", tried, lost_one, lost_all);
}

// The sums themselves may be damaged: an entry then says nothing, and no frame is given up.
TEST(RunRecovery, DamagedSumsCostNothing) {
  const Folder folder("recovery_sums");
  const std::string path = write_run(folder);
  const std::size_t size = std::filesystem::file_size(h5::sums_of(path));
  for (std::size_t at = 0; at < size; at += size / 20 + 1) {
    flip(h5::sums_of(path), at);
    const RunFile run = RunFile::open_for_append(path, all_of(path));
    EXPECT_TRUE(run.lost().empty()) << at;
    EXPECT_EQ(run.n_frame(), kFrames);
  }
}

TEST(RunRecovery, AFileCutShortIsDamaged) {
  const Folder folder("recovery_cut");
  const std::string path = write_run(folder);
  const RunFileCounts counts = all_of(path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const RunFile run = RunFile::open_for_append(path, counts);
  EXPECT_FALSE(run.lost().empty());
}

TEST(RunRecovery, AFileWithoutSumsIsTakenAsItIs) {
  const Folder folder("recovery_none");
  const std::string path = write_run(folder);
  std::filesystem::remove(h5::sums_of(path));
  RunFile run = RunFile::open_for_append(path, all_of(path));
  EXPECT_TRUE(run.lost().empty());
  EXPECT_TRUE(std::filesystem::exists(h5::sums_of(path)));
}

}  // namespace
}  // namespace acinus::io
