/// Run files after a kill, on a full disk and without permission. Forks before any thread exists.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <random>

#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "io/disk.hpp"
#include "io/journal.hpp"
#include "io/page_sums.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "tests/io/expect_frame.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::io {
namespace {

using test::changing_frame;
using test::Folder;
using test::make_frame;

/// Runs `action` in a child and kills it after `delay_us`. Returns what it had reported with the
/// pipe.
int kill_after(int delay_us, const std::function<void(int)>& action) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    action(ends[1]);
    _exit(0);
  }
  close(ends[1]);
  // The clock starts with the first report, so that slow starts do not waste the try.
  int last = -1, got = 0;
  if (read(ends[0], &got, sizeof got) == sizeof got) last = got;
  const timespec delay{delay_us / 1000000, delay_us % 1000000 * 1000L};
  nanosleep(&delay, nullptr);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  while (read(ends[0], &got, sizeof got) == sizeof got) last = got;
  close(ends[0]);
  return last;
}

void report(int pipe_end, int value) {
  EXPECT_EQ(write(pipe_end, &value, sizeof value), ssize_t{sizeof value});
}

TEST(RunFileCrash, KillAtAnyMomentLeavesEveryFinishedFrame) {
  const Folder folder("run_file_kill");
  const std::string path = folder / "run.vtkhdf";
  std::mt19937 random(5);
  int n_checked = 0;
  for (int attempt = 0; attempt < 20; ++attempt) {
    const int finished = kill_after(static_cast<int>(random() % 400000), [&](int pipe_end) {
      RunFile run = RunFile::create(path, {{"seed", "1"}});
      for (int k = 0;; ++k) {
        const std::vector<SeriesValue> sample{{"time", "s", 1.0 * k}};
        run.append_series(sample);
        run.append(changing_frame(k), sample);
        report(pipe_end, k);
      }
    });
    ASSERT_GE(finished, 0);
    int n = 0;
    {
      const RunReader reader(path);
      n = reader.n_frame();
      ASSERT_GE(n, finished + 1);
      ASSERT_LE(n, finished + 2);  // killed after the write, before the report
      for (int k = 0; k < n; ++k) test::expect_same_frame(reader.frame(k), changing_frame(k));
      EXPECT_EQ(std::ssize(reader.series().at("time")), n);
      EXPECT_EQ(std::ssize(reader.observables().at("time")), n);
      n_checked += n;
    }
    EXPECT_TRUE(read_text_file(folder / "run.xmf").ends_with("</Xdmf>\n"));
    RunFile run = RunFile::open_for_append(path, {n, n, 0, n});
    run.append(changing_frame(n));
    test::expect_same_frame(RunReader(path).frame(n), changing_frame(n));
    test::expect_same_frame(RunReader(path).frame(0), changing_frame(0));
  }
  std::printf("20 kills, %d frames read back\n", n_checked);
}

/// Kills rarely hit the short time in which older bytes are overwritten, so here is every stage of
/// it: the first pages have their new content, the others the old one, and the journal is there.
TEST(RunFileCrash, KillWhileOverwritingIsMendedByTheJournal) {
  const Folder folder("run_file_journal");
  const std::string path = folder / "run.vtkhdf";
  RunFile run = RunFile::create(path, {});
  for (int k = 0; k < 2; ++k) run.append(changing_frame(k));
  const std::string old = read_text_file(path), old_sums = read_text_file(h5::sums_of(path));
  run.append(changing_frame(2));
  const std::string changed = read_text_file(path), new_sums = read_text_file(h5::sums_of(path));
  EXPECT_FALSE(std::filesystem::exists(h5::journal_of(path))) << "a finished append needs none";

  h5::Journal journal{old.size(), {}};
  const auto page_count = (old.size() + h5::kPage - 1) / h5::kPage;
  for (std::uint64_t i = 0; i < page_count; ++i) {
    const std::string bytes = changed.substr(i * h5::kPage, h5::kPage);
    if (bytes == old.substr(i * h5::kPage, h5::kPage)) continue;
    std::memcpy(journal.page[i].data(), bytes.data(), bytes.size());
  }
  ASSERT_GE(journal.page.size(), 3U);
  int n_broken = 0;
  for (std::size_t n_done = 0; n_done <= journal.page.size(); ++n_done) {
    std::string torn = changed;
    std::size_t i = 0;
    for (const auto& [index, page] : journal.page) {
      const std::uint64_t begin = index * h5::kPage;
      const std::uint64_t size = std::min(h5::kPage, old.size() - begin);
      if (i++ >= n_done) torn.replace(begin, size, old, begin, size);
    }
    write_text_file(path, torn);
    write_text_file(h5::sums_of(path), n_done % 2 == 0 ? old_sums : new_sums);
    try {
      const RunReader reader(path);
      for (int k = 0; k < 2; ++k) reader.frame(k);
    } catch (const Error&) {
      ++n_broken;
    }
    ASSERT_TRUE(h5::write_journal(path, journal));
    {
      const RunReader reader(path);
      ASSERT_EQ(reader.n_frame(), 3);
      for (int k = 0; k < 3; ++k) test::expect_same_frame(reader.frame(k), changing_frame(k));
    }
    EXPECT_TRUE(read_text_file(path) == torn) << "a reader must not write";
    RunFile again = RunFile::open_for_append(path, {3, 0, 0});
    EXPECT_FALSE(std::filesystem::exists(h5::journal_of(path)));
    again.append(changing_frame(3));
    for (int k = 0; k < 4; ++k) {
      test::expect_same_frame(RunReader(path).frame(k), changing_frame(k));
    }
  }
  EXPECT_GT(n_broken, 0) << "what the journal is for";
  std::printf("%zu stages, %d of them unreadable without the journal\n", journal.page.size() + 1,
              n_broken);
}

TEST(RunFileCrash, CutJournalIsIgnored) {
  const Folder folder("journal_cut");
  const std::string path = folder / "file";
  h5::Journal journal{5000, {}};
  journal.page[0].fill(std::byte{1});
  journal.page[1].fill(std::byte{2});
  ASSERT_TRUE(h5::write_journal(path, journal));
  const std::string whole = read_text_file(h5::journal_of(path));
  EXPECT_EQ(h5::read_journal(path).page, journal.page);
  EXPECT_EQ(h5::read_journal(path).end, 5000U);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{10}, std::size_t{24}, std::size_t{4128}, whole.size() - 1}) {
    write_text_file(h5::journal_of(path), whole.substr(0, size));
    EXPECT_TRUE(h5::read_journal(path).page.empty()) << size;
  }
  std::string flipped = whole;
  flipped[300] ^= 1;
  write_text_file(h5::journal_of(path), flipped);
  EXPECT_TRUE(h5::read_journal(path).page.empty());
}

TEST(RunFileCrash, KillWhileSavingLeavesACheckpoint) {
  const Folder folder("checkpoint_kill");
  std::mt19937 random(6);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const int saved = kill_after(static_cast<int>(random() % 60000), [&](int pipe_end) {
      for (int k = 0;; ++k) {
        CheckpointData data;
        data.put("position", std::vector<double>(20000, k));
        save_checkpoint(folder.path, CheckpointSource(data));
        report(pipe_end, k);
      }
    });
    const LoadedCheckpoint loaded = load_checkpoint(folder.path);
    EXPECT_EQ(loaded.warning, "");
    const auto& position = loaded.data.numbers("position");
    ASSERT_EQ(position.size(), 20000U);
    EXPECT_GE(position[0], saved);
    EXPECT_LE(position[0], saved + 1);
  }
}

void expect_file_error(const std::string& part, const std::function<void()>& action) {
  EXPECT_CONTAINS(acinus::test::message_of(action, Exit::kFileError), part);
}

/// Files may not grow beyond `limit` bytes while this exists: the disk is "full".
class FullDisk {
 public:
  explicit FullDisk(std::size_t limit) {
    old_handler_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit tight = old_;
    tight.rlim_cur = limit;
    setrlimit(RLIMIT_FSIZE, &tight);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &old_);
    signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int) = nullptr;
};

TEST(RunFileCrash, FullDiskLeavesTheFileAsItWasAndTheRunCanGoOn) {
  const Folder folder("run_file_full");
  const std::string path = folder / "run.vtkhdf";
  RunFile run = RunFile::create(path, {});
  for (int k = 0; k < 3; ++k) run.append(make_frame(k, 200, 10));
  const std::string before = read_text_file(path);
  const std::vector<SeriesValue> sample{{"time", "s", 1.0}};
  run.append_series(sample);
  for (const std::size_t room : {0, 100, 5000, 20000}) {
    const FullDisk full(before.size() + room);
    expect_file_error("File too large", [&] { run.append(make_frame(3, 300, 10)); });
    EXPECT_EQ(run.n_frame(), 3);
  }
  EXPECT_TRUE(read_text_file(path) == before) << "a failed append must leave every byte";
  run.append(make_frame(3, 300, 10));
  const RunReader reader(path);
  ASSERT_EQ(reader.n_frame(), 4);
  for (int k = 0; k < 3; ++k) test::expect_same_frame(reader.frame(k), make_frame(k, 200, 10));
  test::expect_same_frame(reader.frame(3), make_frame(3, 300, 10));
  EXPECT_EQ(reader.series().at("time"), std::vector<double>{1.0});
}

TEST(RunFileCrash, FullDiskKeepsTheOlderCheckpoint) {
  const Folder folder("checkpoint_full");
  CheckpointData small, large;
  small.put("position", std::vector<double>(10, 1.5));
  large.put("position", std::vector<double>(100000, 2.5));
  save_checkpoint(folder.path, CheckpointSource(small));
  {
    const FullDisk full(100000);
    expect_file_error("File too large",
                      [&] { save_checkpoint(folder.path, CheckpointSource(large)); });
  }
  EXPECT_EQ(load_checkpoint(folder.path).data.numbers("position"), std::vector<double>(10, 1.5));
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
}

TEST(RunFileCrash, ADeviceIsNoRunFile) {
  expect_file_error("a regular file is needed", [] { RunFile::create("/dev/full", {}); });
}

TEST(RunFileCrash, UnwritableFoldersAreNamed) {
  const Folder folder("run_file_denied");
  expect_file_error("none/run.vtkhdf: cannot create the file: No such file or directory",
                    [&] { RunFile::create(folder / "none/run.vtkhdf", {}); });
  expect_file_error("No such file or directory",
                    [&] { save_checkpoint(folder / "none", CheckpointSource()); });
  std::filesystem::create_directory(folder / "locked");
  std::filesystem::permissions(
      folder / "locked", std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const pid_t child = fork();
  if (child == 0) {  // root may write everywhere: become somebody else
    if (geteuid() == 0 && (chmod(folder.path.c_str(), 0755) != 0 ||
                           chmod((folder / "locked").c_str(), 0555) != 0 || seteuid(65534) != 0)) {
      _exit(9);
    }
    int n = 0;
    const auto denied = [&](const std::function<void()>& action) {
      try {
        action();
      } catch (const Error& error) {
        n += error.code() == Exit::kFileError &&
             std::string(error.what()).find("Permission denied") != std::string::npos;
      }
    };
    denied([&] { RunFile::create(folder / "locked/run.vtkhdf", {}); });
    denied([&] { save_checkpoint(folder / "locked", CheckpointSource()); });
    denied([&] { write_text_file(folder / "locked/run.xmf", "x"); });
    _exit(n);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

}  // namespace
}  // namespace acinus::io
