/// Reads the kept corpus of a target, then mutations of it and of valid files, for some seconds.
/// usage: fuzz_replay TARGET SECONDS [SEED]      fuzz_replay TARGET --count N [SEED]
///        fuzz_replay --seeds TARGET FOLDER
/// The kept corpus holds what once went wrong. Ends with exit code 1 and leaves the input behind if
/// a reader does anything but accept or refuse it; an input that hangs ends it too.

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "io/disk.hpp"
#include "tests/fuzz/campaign.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/targets.hpp"

namespace acinus::fuzz {
namespace {

namespace fs = std::filesystem;
int replay(const Target& target, double seconds, std::uint64_t seed) {
  const std::string folder = io::make_temporary_folder("acinus_fuzz_");
  const std::vector<std::string> corpus = make_corpus(target.name, folder + "/seeds");
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::mt19937_64 random(seed);
  std::size_t tried = 0, accepted = 0;
  for (std::size_t k = 0; k < corpus.size() || elapsed() < seconds; ++k) {
    const std::string bytes = k < corpus.size() ? corpus[k] : mutate(corpus, random);
    watch_for_hangs();
    try {
      accepted += try_bytes(target, folder, bytes) ? 1 : 0;
    } catch (const std::exception& fault) {
      std::printf("%s: %s\nthe input is left in %s\n", target.name.c_str(), fault.what(),
                  folder.c_str());
      return 1;
    }
    ++tried;
  }
  if (accepted == 0) {
    std::printf("%s: no input was accepted, not even the valid ones\n", target.name.c_str());
    return 1;
  }
  fs::remove_all(folder);
  std::printf("%s: %zu inputs, %zu of them accepted, in %.1f s\n", target.name.c_str(), tried,
              accepted, elapsed());
  return 0;
}

}  // namespace
}  // namespace acinus::fuzz

int main(int n_argument, char** argument) {
  using namespace acinus::fuzz;
  const std::vector<std::string> words(argument + 1, argument + n_argument);
  if (words.size() == 3 && words[0] == "--seeds") {
    find_target(words[1]).write_seeds(words[2]);
    return 0;
  }
  if (words.size() >= 3 && words[1] == "--count")
    return run_campaign(find_target(words[0]), std::stoull(words[2]),
                        words.size() > 3 ? std::stoull(words[3]) : 1);
  if (words.size() < 2) {
    std::fprintf(stderr,
                 "usage: fuzz_replay TARGET SECONDS [SEED]\n"
                 "       fuzz_replay TARGET --count N [SEED]\n"
                 "       fuzz_replay --seeds TARGET FOLDER\n");
    return 2;
  }
  return replay(find_target(words[0]), std::stod(words[1]),
                words.size() > 2 ? std::stoull(words[2]) : 1);
}
