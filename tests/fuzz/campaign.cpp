#include "tests/fuzz/campaign.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "io/disk.hpp"
#include "tests/fuzz/mutate.hpp"

namespace acinus::fuzz {
namespace {

namespace fs = std::filesystem;
constexpr double kMostMemory = 1.0e9;  // bytes
constexpr const char* kFound = "fuzz_found";

/// Shared by both processes.
struct Progress {
  std::uint64_t next = 0;  ///< the input that is read, or read next
  std::uint64_t accepted = 0, refused = 0;
  double longest = 0;  ///< s
};

/// Processor time of this process, s.
double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::string input(const std::vector<std::string>& corpus, std::uint64_t k, std::uint64_t seed) {
  std::seed_seq words{seed, k};
  std::mt19937_64 random(words);
  return mutate(corpus, random);
}

/// Reads on until all are read or one of them ends this process.
[[noreturn]] void work(const Target& target, const std::vector<std::string>& corpus,
                       const std::string& folder, std::uint64_t n, std::uint64_t seed,
                       Progress& progress) {
  for (; progress.next < n; ++progress.next) {
    const std::string bytes = input(corpus, progress.next, seed);
    const double start = cpu_seconds();
    watch_for_hangs();
    try {
      ++(try_bytes(target, folder, bytes) ? progress.accepted : progress.refused);
    } catch (const std::exception& fault) {
      std::fprintf(stderr, "fault: %s\n", fault.what());
      _exit(1);
    }
    progress.longest = std::max(progress.longest, cpu_seconds() - start);
  }
  _exit(0);
}

/// True if the topmost function of a sanitizer's report that is neither its own nor of the C
/// library belongs to the library of HDF5.
bool blames_hdf5(const std::string& report) {
  std::ifstream text(report);
  for (std::string line; std::getline(text, line);) {
    if (line.find("acinus::") != std::string::npos) return false;
    if (line.find(" in H5") != std::string::npos || line.find("libhdf5") != std::string::npos)
      return true;
  }
  return false;
}

void send_errors_to(const std::string& file) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (descriptor < 0 || dup2(descriptor, STDERR_FILENO) < 0) _exit(1);
  close(descriptor);
}

}  // namespace

void watch_for_hangs() {
  constexpr int kMostCpu = 10, kMostWall = 60;  // s
  const itimerval limit{{0, 0}, {kMostCpu, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
  alarm(kMostWall);
}

int run_campaign(const Target& target, std::uint64_t n, std::uint64_t seed) {
  const std::string folder = io::make_temporary_folder("acinus_fuzz_");
  const std::vector<std::string> corpus = make_corpus(target.name, folder + "/seeds");
  void* shared =
      mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return 1;
  Progress& progress = *new (shared) Progress;
  std::uint64_t library = 0, faults = 0;
  double memory = 0;
  while (progress.next < n) {
    const std::string words = folder + "/words.txt";
    const pid_t child = fork();
    if (child == 0) {
      send_errors_to(words);
      work(target, corpus, folder, n, seed, progress);
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    memory = std::max(memory, 1024.0 * static_cast<double>(used.ru_maxrss));
    if (progress.next >= n) break;
    const bool blamed_on_library = target.guarded && blames_hdf5(words);
    ++(blamed_on_library ? library : faults);
    if (!blamed_on_library) {
      fs::create_directories(kFound);
      const std::string kept =
          std::string(kFound) + "/" + target.name + "_" + std::to_string(progress.next);
      std::ofstream(kept, std::ios::binary) << input(corpus, progress.next, seed);
      fs::copy_file(words, kept + ".txt", fs::copy_options::overwrite_existing);
      std::printf("%s: input %llu ended the process: %s\n", target.name.c_str(),
                  static_cast<unsigned long long>(progress.next), kept.c_str());
    }
    ++progress.next;
  }
  fs::remove_all(folder);
  std::printf(
      "%-16s %6llu inputs: %6llu accepted, %6llu refused, %3llu ended libhdf5, %3llu faults; "
      "at most %.1f s and %.0f MB\n",
      target.name.c_str(), static_cast<unsigned long long>(n),
      static_cast<unsigned long long>(progress.accepted),
      static_cast<unsigned long long>(progress.refused), static_cast<unsigned long long>(library),
      static_cast<unsigned long long>(faults), progress.longest, 1e-6 * memory);
  return faults > 0 || memory > kMostMemory || progress.accepted == 0 ? 1 : 0;
}

}  // namespace acinus::fuzz
