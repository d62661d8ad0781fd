/// Reads the kept corpus of a target, then mutations of it and of valid files, for some seconds.
/// usage: fuzz_replay TARGET SECONDS [SEED]      fuzz_replay --seeds TARGET FOLDER
/// The kept corpus holds what once went wrong. Ends with exit code 1 and leaves the input behind if
/// a reader does anything but accept or refuse it; an input that takes ten seconds ends it too.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "core/io/disk.hpp"
#include "tests/fuzz/targets.hpp"

namespace acinus::fuzz {
namespace {

namespace fs = std::filesystem;
constexpr unsigned kHang = 10;  ///< s

std::vector<std::string> read_folder(const std::string& folder) {
  std::vector<fs::path> paths;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<std::string> bytes;
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    bytes.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return bytes;
}

/// Changes of the kinds that happen: bytes flipped, cut out, doubled, taken from another file,
/// numbers replaced by others that are hard to bear.
std::string mutate(const std::vector<std::string>& corpus, std::mt19937_64& random) {
  static const std::vector<std::string> hard{"1e999",       "-1",
                                             "0",           "nan",
                                             "1e-320",      "18446744073709551616",
                                             "-0.0",        "1e95 J/m^2",
                                             "null",        "[]",
                                             "{}",          "\"\"",
                                             "true",        "2147483648",
                                             "-2147483649", "\xff",
                                             "inf",         "1e10",
                                             "\n",          "9999999999999999999999999999999999"};
  const auto below = [&](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
  std::string text = corpus[below(corpus.size())];
  for (std::size_t n = 1 + below(4); n > 0; --n) {
    const std::size_t at = below(text.size() + 1), length = 1 + below(16);
    switch (below(7)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.resize(at);
        break;
      case 4: {
        const std::string& other = corpus[below(corpus.size())];
        text.insert(at, other.substr(below(other.size()), 1 + below(200)));
        break;
      }
      case 5: {  // a number or word
        const auto digit = text.find_first_of("0123456789", at);
        if (digit == std::string::npos) break;
        const auto end = text.find_first_not_of("0123456789.eE+-", digit);
        text.replace(digit, std::min(end, text.size()) - digit, hard[below(hard.size())]);
        break;
      }
      default:
        text.insert(at, hard[below(hard.size())]);
        break;
    }
  }
  return text;
}

int replay(const Target& target, double seconds, std::uint64_t seed) {
  const std::string folder = io::make_temporary_folder("acinus_fuzz_");
  fs::create_directories(folder + "/seeds");
  target.write_seeds(folder + "/seeds");
  std::vector<std::string> corpus = read_folder(folder + "/seeds");
  for (std::string& kept : read_folder(ACINUS_SOURCE_DIR "/tests/fuzz/corpus/" + target.name))
    corpus.push_back(std::move(kept));
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::mt19937_64 random(seed);
  std::size_t tried = 0, accepted = 0;
  for (std::size_t k = 0; k < corpus.size() || elapsed() < seconds; ++k) {
    const std::string bytes = k < corpus.size() ? corpus[k] : mutate(corpus, random);
    alarm(kHang);
    try {
      accepted += try_bytes(target, folder, bytes) ? 1 : 0;
    } catch (const std::exception& fault) {
      std::printf("%s: %s\nthe input is left in %s\n", target.name.c_str(), fault.what(),
                  folder.c_str());
      return 1;
    }
    ++tried;
  }
  alarm(0);
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
  if (words.size() < 2) {
    std::fprintf(stderr,
                 "usage: fuzz_replay TARGET SECONDS [SEED]\n"
                 "       fuzz_replay --seeds TARGET FOLDER\n");
    return 2;
  }
  return replay(find_target(words[0]), std::stod(words[1]),
                words.size() > 2 ? std::stoull(words[2]) : 1);
}
