#pragma once
/// Runs of the program in a temporary folder, with its output and files.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "tests/messages.hpp"
#include "tests/paths.hpp"

namespace acinus::runs {
namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

struct Outcome {
  int code = -1;     ///< exit code; -1 when a signal ended the program
  std::string text;  ///< stdout and stderr
};

/// One running program. Its output comes through a pipe, so a line can be awaited without sleeping.
class Process {
 public:
  /// @param file_limit  largest file it may write, bytes; 0 = any
  Process(const fs::path& folder, const Words& words, rlim_t file_limit = 0) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    Words all{test::program_path()};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    id_ = fork();
    if (id_ == 0) {  // only async-signal-safe calls from here on
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      if (chdir(folder.c_str()) != 0) _exit(126);
      const rlimit limit{file_limit, file_limit};
      if (file_limit > 0 && setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    output_ = ends[0];
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      wait();
    }
  }

  /// Reads until `part` was printed; false when the program ended before.
  bool await(const std::string& part) {
    while (text_.find(part) == std::string::npos)
      if (!read_some()) return false;
    return true;
  }
  void send(int signal) const { kill(id_, signal); }
  pid_t id() const { return id_; }
  Outcome wait() {
    while (read_some()) continue;
    close(output_);
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_};
  }

 private:
  bool read_some() {
    std::array<char, 4096> buffer{};
    const ssize_t n = read(output_, buffer.data(), buffer.size());
    if (n <= 0) return false;
    text_.append(buffer.data(), static_cast<std::size_t>(n));
    return true;
  }

  pid_t id_ = -1;
  int output_ = -1;
  std::string text_;
};

/// Fresh folder per test, removed when the test is done.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              (std::string("acinus_") + info->name() + "_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ProgramTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  Outcome call(const Words& words, rlim_t file_limit = 0) const {
    return Process(folder_, words, file_limit).wait();
  }
  /// run SCENE --out OUT --quiet and more words; one thread unless these say otherwise, since
  /// tests run side by side.
  static Words run_words(const std::string& scene, const std::string& out, const Words& more = {}) {
    Words words{"run", scene, "--out", out, "--quiet"};
    if (std::ranges::find(more, "--threads") == more.end())
      words.insert(words.end(), {"--threads", "1"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string text(const std::string& name) const { return io::read_text_file(path(name)); }
  Json json(const std::string& name) const { return Json::parse(text(name)); }
  Json summary(const std::string& run) const { return json(run + "/summary.json"); }
  io::RunReader reader(const std::string& run) const {
    return io::RunReader((path(run) / "run.vtkhdf").string());
  }
  std::vector<std::string> names_in(const std::string& run) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path(run)))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  /// Compares two runs: state, counters and every frame must agree to the last bit.
  void expect_same(const std::string& a, const std::string& b) const;

  fs::path folder_;
};

inline std::vector<io::Frame> read_frames(const io::RunReader& run) {
  std::vector<io::Frame> frames;
  for (int k = 0; k < run.n_frame(); ++k) frames.push_back(run.frame(k));
  return frames;
}

/// Checks that the frames of a are the first frames of b, bit for bit.
inline void expect_first_frames(const std::vector<io::Frame>& a, const std::vector<io::Frame>& b,
                                const std::string& what) {
  ASSERT_LE(a.size(), b.size()) << what;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const io::Frame &p = a[k], &q = b[k];
    EXPECT_EQ(p.time_s, q.time_s) << what << " frame " << k;
    EXPECT_EQ(p.point, q.point) << what << " frame " << k;
    EXPECT_EQ(p.triangle, q.triangle) << what << " frame " << k;
    EXPECT_EQ(p.cell_id, q.cell_id) << what << " frame " << k;
    ASSERT_EQ(p.point_data.size(), q.point_data.size()) << what << " frame " << k;
    for (std::size_t f = 0; f < p.point_data.size(); ++f)
      EXPECT_EQ(p.point_data[f].value, q.point_data[f].value)
          << what << " " << p.point_data[f].name;
    ASSERT_EQ(p.cells.columns.size(), q.cells.columns.size()) << what << " frame " << k;
    for (std::size_t c = 0; c < p.cells.columns.size(); ++c)
      EXPECT_EQ(p.cells.columns[c].value, q.cells.columns[c].value)
          << what << " " << p.cells.columns[c].name;
  }
}

inline void ProgramTest::expect_same(const std::string& a, const std::string& b) const {
  const Json p = summary(a), q = summary(b);
  for (const char* key : {"state_hash", "steps", "cells", "balance", "penetration_um", "measures"})
    EXPECT_EQ(p.at(key), q.at(key)) << key << " " << a << " " << b;
  const io::RunReader x = reader(a), y = reader(b);
  EXPECT_EQ(x.n_frame(), y.n_frame());
  EXPECT_EQ(x.series(), y.series());
  EXPECT_EQ(x.observables(), y.observables());
  expect_first_frames(read_frames(x), read_frames(y), a + " " + b);
}

/// DCM cell and CBM cell that touch, 42 nodes, 8 minutes.
inline constexpr const char* kPair = R"({
  "seed": 3,
  "time": {"end": "8 min", "step": "30 s"},
  "cell_types": {"hepatocyte": {"dcm": {"nodes": 42}}},
  "cells": {"source": "list", "list": [
    {"position": ["0 um", "0 um", "0 um"], "model": "dcm"},
    {"position": ["23.5 um", "0 um", "0 um"], "model": "cbm"}]},
  "output": {"every": "2 min"}
})";

/// Touching cells with start-up, in which two neighbours of each model meet.
inline constexpr const char* kGrowing = R"({
  "seed": 3,
  "time": {"end": "6 min", "step": "30 s"},
  "start_up": {"enabled": true, "growth_time": "5 min", "adhesion_ramp": "2 min",
               "max_duration": "2 min"},
  "cell_types": {"hepatocyte": {"dcm": {"nodes": 42}}},
  "cells": {"source": "list", "list": [
    {"position": ["0 um", "0 um", "0 um"], "model": "dcm"},
    {"position": ["23.3 um", "0 um", "0 um"], "model": "cbm"},
    {"position": ["0 um", "23.6 um", "0 um"], "model": "dcm"},
    {"position": ["23.4 um", "23.7 um", "0 um"], "model": "cbm"}]},
  "motility": {"random": true, "leader_force": "0.1 nN", "leader_grid": "2 min"},
  "output": {"every": "2 min", "start_up": true}
})";

}  // namespace acinus::runs
